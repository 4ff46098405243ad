"""The passes of an iteration over cells, compiled; importing them compiles or loads them.

A pass serves the positions `first` to `last`, so that threads share them, and leaves its sums of
each position in a row of `sums`: what is added over the positions is added there in their order,
with the same bits for any number of threads. Fields have the shape (positions, nx, ny). The largest
pressure has it too, or one position for all, or one row for all cells.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray
from rocket_fft import c2c, c2r, r2c

(
    FORCE,
    OPENING,
    PENETRATION,
    APPROACH,
    FACE,
    MEAN,
    RAISED,
    TURNED,
    STEEPNESS,
    OVERLAP,
    ALONG,
    SLOPE,
    MEETS_BOUND,
    CURVATURE,
) = range(14)
"""Columns of `sums`."""
_COLUMNS = 1 << 12
"""Complex numbers that a processor's first cache holds: lines are transformed so many at a time."""
_ROUND_OFF = 1e-15
"""A few units of rounding: a sum is no more exact; as in the kernel's projection."""
_NEAR = 1e-12
"""Good enough for `_balance` to correct; as in the kernel's projection."""
_LINES = np.array([1])
"""The axis of a line."""

_FIELD, _TABLE, _ROW, _MODES = "f8[:,:,::1]", "f8[:,::1]", "f8[::1]", "c16[:,::1]"
# Sums may be reordered: what is given is fixed, so the order is, on one machine.
_OPTIONS: dict[str, Any] = {
    "nogil": True,
    "cache": True,
    "error_model": "numpy",
    "fastmath": {"reassoc", "nsz", "contract", "arcp"},
}
_inner = njit(**_OPTIONS)
# Within numba: a truth value that a call returns keeps loops from being vectorised.
_inline = njit(inline="always", **_OPTIONS)


def _compiled(*types):
    return njit(f"void({','.join(types)},i8,i8)", **_OPTIONS)


def empty_sums(positions: int) -> NDArray[np.float64]:
    """Return room for the sums of so many positions."""
    return np.zeros((positions, CURVATURE + 1))


@_inline
def _on_face(pressure, deformed, most):
    """Whether a cell is between the bounds, or at a bound and about to leave it."""
    return ((pressure < most) | (deformed > 0)) & ((pressure > 0) | (deformed < 0))


@_inline
def _outside(pressure, most):
    return (pressure < 0) | (pressure > most)


@_inner
def _most(limit, k, i):
    """Return the largest pressures in a row of a position."""
    return limit[min(k, limit.shape[0] - 1), min(i, limit.shape[1] - 1)]


@_inner
def _convolve(pressure, displacement, spectrum, modes, lines):
    """Write the displacement under a pressure, and return the sum of their products.

    The spectrum, transposed, has the factors of both inverse transforms in it. `modes` keeps the
    transposed modes of the rows of the box alone; `lines` a few padded rows.
    """
    (nx, ny), (some, padded) = pressure.shape, lines.shape
    count, length = modes.shape
    for first in range(0, nx, some):
        n = min(some, nx - first)
        for i in range(n):
            line, row = lines[i], pressure[first + i]
            for j in range(ny):
                line[j] = row[j]
            for j in range(ny, padded):
                line[j] = 0.0
        r2c(lines[:n], modes.T[first : first + n], _LINES, True, 1.0, 1)
    several = max(8, _COLUMNS // length)
    for first in range(0, count, several):
        part = modes[first : first + several]
        for c in range(len(part)):
            line = part[c]
            for i in range(nx, length):
                line[i] = 0.0
        c2c(part, part, _LINES, True, 1.0, 1)
        for c in range(len(part)):
            line, factor = part[c], spectrum[first + c]
            for i in range(length):
                line[i] *= factor[i]
        c2c(part, part, _LINES, False, 1.0, 1)
    total = 0.0
    for first in range(0, nx, some):
        n = min(some, nx - first)
        c2r(modes.T[first : first + n], lines[:n], _LINES, False, 1.0, 1)
        for i in range(n):
            line, row, into = lines[i], pressure[first + i], displacement[first + i]
            here = 0.0
            for j in range(ny):
                into[j] = line[j]
                here += row[j] * line[j]
            total += here
    return total


@_compiled(_FIELD, _FIELD, _TABLE, _TABLE, _MODES, _TABLE)
def convolve(pressure, displacement, sums, spectrum, modes, lines, first, last):
    """Write the displacements under pressures, and the sums of their products."""
    for k in range(first, last):
        sums[k, CURVATURE] = _convolve(pressure[k], displacement[k], spectrum, modes, lines)


@_inner
def _approach_at_bounds(pressure, deformed):
    """Return the approach where no cell is between the bounds: any value between the two."""
    highest, lowest = -np.inf, np.inf
    for i in range(len(pressure)):
        for j in range(pressure.shape[1]):
            if pressure[i, j] > 0:
                highest = max(highest, deformed[i, j])
            else:
                lowest = min(lowest, deformed[i, j])
    return 0.5 * (highest + lowest) if lowest < np.inf else highest


@_compiled(*[_FIELD] * 5, _ROW, _TABLE)
def judge(pressure, displacement, gap, deformed, limit, total, sums, first, last):
    """Find the approach and the deformed gap, and the residuals; count the cells of the face."""
    _, nx, ny = pressure.shape
    lowest, highest, deepest, below = np.empty(ny), np.empty(ny), np.empty(ny), np.empty(ny)
    for k in range(first, last):
        lowest[:], highest[:], deepest[:], below[:] = np.inf, -np.inf, -np.inf, 0.0
        between, level, load = 0, 0.0, 0.0
        for i in range(nx):
            p, u, g, d = pressure[k, i], displacement[k, i], gap[k, i], deformed[k, i]
            most = _most(limit, k, i)
            n, mean, here = 0, 0.0, 0.0
            for j in range(ny):
                d[j] = u[j] + g[j]
                free = (p[j] > 0) & (p[j] < most[j])
                n += 1 if free else 0
                mean += d[j] if free else 0.0
                here += p[j]
            between, level, load = between + n, level + mean, load + here
            # A largest value of each column: a compiler cannot do more of one value at a time.
            for j in range(ny):
                lowest[j] = min(lowest[j], g[j] if p[j] > 0 else np.inf)
                highest[j] = max(highest[j], g[j] if p[j] > 0 else -np.inf)
                deepest[j] = max(deepest[j], u[j] if p[j] > 0 else -np.inf)
        at_bounds = between == 0
        approach = _approach_at_bounds(pressure[k], deformed[k]) if at_bounds else level / between
        opening, face, mean = 0.0, 0, 0.0
        for i in range(nx):
            p, d, most = pressure[k, i], deformed[k, i], _most(limit, k, i)
            here, n, there = 0.0, 0, 0.0
            for j in range(ny):
                q, v = p[j], d[j] - approach
                d[j] = v
                here += q * abs(v) if (q < most[j]) | (v > 0) else 0.0
                overlap = 0.0 if q > 0 else v
                below[j] = overlap if overlap < below[j] else below[j]
                on = _on_face(q, v, most[j])
                n += 1 if on else 0
                there += v if on else 0.0
            opening, face, mean = opening + here, face + n, mean + there
        scale = max(deepest.max(), highest.max() - lowest.min())
        scale = 1.0 if scale == 0 else scale
        sums[k, FORCE] = abs(load / total[k] - 1.0)
        sums[k, OPENING] = opening / (total[k] * scale)
        sums[k, PENETRATION] = 0.0 - below.min() / scale
        sums[k, APPROACH] = approach
        sums[k, FACE], sums[k, MEAN] = max(face, 1), mean / max(face, 1)


@_compiled(*[_FIELD] * 5, _TABLE, _TABLE, _MODES, _TABLE)
def precondition(pressure, deformed, limit, residual, z, sums, spectrum, modes, lines, first, last):
    """Centre the residual on the face, and convolve it."""
    _, nx, ny = pressure.shape
    for k in range(first, last):
        mean = sums[k, MEAN]
        for i in range(nx):
            p, d, r, most = pressure[k, i], deformed[k, i], residual[k, i], _most(limit, k, i)
            for j in range(ny):
                r[j] = d[j] - mean if _on_face(p[j], d[j], most[j]) else 0.0
        _convolve(residual[k], z[k], spectrum, modes, lines)


@_compiled(*[_FIELD] * 7, _TABLE)
def steepen(pressure, deformed, limit, residual, gradient, direction, z, sums, first, last):
    """Find the sums of the preconditioned residual; `gradient` is the residual before."""
    _, nx, ny = pressure.shape
    for k in range(first, last):
        # The sums of the centred z: the residual is centred already.
        raised, turned, past, steepness, overlap = 0.0, 0.0, 0.0, 0.0, 0.0
        for i in range(nx):
            p, d, most = pressure[k, i], deformed[k, i], _most(limit, k, i)
            w, v, r, g = z[k, i], direction[k, i], residual[k, i], gradient[k, i]
            sum_w, sum_v, sum_g, sum_r, here = 0.0, 0.0, 0.0, 0.0, 0.0
            for j in range(ny):
                on = _on_face(p[j], d[j], most[j])
                sum_w += w[j] if on else 0.0
                sum_v += v[j] if on else 0.0
                sum_g += g[j] if on else 0.0
                here += w[j] * g[j] if on else 0.0
                sum_r += w[j] * r[j]
            raised, turned, past = raised + sum_w, turned + sum_v, past + sum_g
            steepness, overlap = steepness + sum_r, overlap + here
        sums[k, RAISED], sums[k, TURNED] = raised / sums[k, FACE], turned / sums[k, FACE]
        sums[k, STEEPNESS], sums[k, OVERLAP] = steepness, overlap - sums[k, RAISED] * past


@_inner
def _turn(pressure, deformed, limit, residual, direction, z, sums, beta, length, k):
    """Turn the direction, all of it centred, and see whether a step along it meets a bound."""
    _, nx, ny = pressure.shape
    raised, turned = sums[k, RAISED], sums[k, TURNED]
    along, downhill, beyond = 0.0, 0.0, 0
    for i in range(nx):
        p, d, most = pressure[k, i], deformed[k, i], _most(limit, k, i)
        r, v, w = residual[k, i], direction[k, i], z[k, i]
        here, there, n = 0.0, 0.0, 0
        for j in range(ny):
            on = _on_face(p[j], d[j], most[j])
            v[j] = beta * (v[j] - turned) - (w[j] - raised) if on else 0.0
            here += v[j] * r[j]
            there += v[j] * d[j]
            n += 1 if _outside(p[j] + length * v[j], most[j]) else 0
        along, downhill, beyond = along + here, downhill + there, beyond + n
    sums[k, ALONG], sums[k, SLOPE] = along, length * downhill
    sums[k, MEETS_BOUND] = 1.0 if beyond > 0 else 0.0


@_inner
def _shift(values, target, most):
    """Return the μ at which clip(values + μ, 0, most) adds up to a target."""
    low, high = -values.max(), -np.inf
    bounded = most.max() < np.inf
    for c in range(len(values)):
        high = max(high, (most[c] if bounded else target) - values[c])
    shift = 0.0 if low < 0.0 < high else 0.5 * (low + high)
    for _ in range(200):
        total, between = 0.0, 0
        for c in range(len(values)):
            moved = min(max(values[c] + shift, 0.0), most[c])
            total += moved
            between += 1 if (moved > 0) & (moved < most[c]) else 0
        excess = total - target
        if abs(excess) <= _NEAR * target:
            break
        if excess > 0:
            high = shift
        else:
            low = shift
        step = shift - excess / between if between else low
        if not low < step < high:
            step = 0.5 * (low + high)
        if step == shift or not low < step < high:
            break
        shift = step
    return shift


@_inner
def _balance(pressure, limit, k, total):
    """Remove the round-off in the sum of a pressure: cells between the bounds change alike."""
    nx, ny = pressure.shape
    for _ in range(2):
        load, between = 0.0, 0
        for i in range(nx):
            p, most = pressure[i], _most(limit, k, i)
            here, n = 0.0, 0
            for j in range(ny):
                here += p[j]
                n += 1 if (p[j] > 0) & (p[j] < most[j]) else 0
            load, between = load + here, between + n
        missing = total - load
        if abs(missing) <= _ROUND_OFF * total or between == 0:
            break
        missing /= between
        for i in range(nx):
            p, most = pressure[i], _most(limit, k, i)
            for j in range(ny):
                free = (p[j] > 0) & (p[j] < most[j])
                p[j] = min(max(p[j] + (missing if free else 0.0), 0.0), most[j])


@_inner
def _step(pressure, deformed, limit, direction, change, ahead, total, sums, length, k):
    """Write the step, and where it ends at a position at which it is projected onto a bound."""
    _, nx, ny = pressure.shape
    if sums[k, MEETS_BOUND] == 0:
        for i in range(nx):
            v, c = direction[k, i], change[k, i]
            for j in range(ny):
                c[j] = length * v[j]
        return
    values, tops = np.empty(nx * ny), np.empty(nx * ny)
    count, rest = 0, 0.0
    for i in range(nx):
        p, d, most, v = pressure[k, i], deformed[k, i], _most(limit, k, i), direction[k, i]
        for j in range(ny):
            if _on_face(p[j], d[j], most[j]):
                values[count], tops[count] = p[j] + length * v[j], most[j]
                count += 1
            else:
                rest += p[j]
    shift = _shift(values[:count], total[k] - rest, tops[:count])
    for i in range(nx):
        p, d, most, v = pressure[k, i], deformed[k, i], _most(limit, k, i), direction[k, i]
        there = ahead[k, i]
        for j in range(ny):
            moved = min(max(p[j] + length * v[j] + shift, 0.0), most[j])
            there[j] = moved if _on_face(p[j], d[j], most[j]) else p[j]
    _balance(ahead[k], limit, k, total[k])
    slope = 0.0
    for i in range(nx):
        p, d, there, c = pressure[k, i], deformed[k, i], ahead[k, i], change[k, i]
        here = 0.0
        for j in range(ny):
            c[j] = there[j] - p[j]
            here += c[j] * d[j]
        slope += here
    sums[k, SLOPE] = slope


@njit(
    f"void({','.join([_FIELD] * 8)},{_ROW},{_TABLE},f8,f8,{_TABLE},{_MODES},{_TABLE},i8,i8)",
    **_OPTIONS,
)
def advance(
    pressure,
    deformed,
    limit,
    residual,
    direction,
    change,
    ahead,
    response,
    total,
    sums,
    beta,
    length,
    spectrum,
    modes,
    lines,
    first,
    last,
):
    """Turn the direction, step along it, and write the response; `change` begins as z."""
    for k in range(first, last):
        _turn(pressure, deformed, limit, residual, direction, change, sums, beta, length, k)
        _step(pressure, deformed, limit, direction, change, ahead, total, sums, length, k)
        sums[k, CURVATURE] = _convolve(change[k], response[k], spectrum, modes, lines)


@_inner
def _dot(a, b):
    total = 0.0
    for i in range(len(a)):
        row, other = a[i], b[i]
        here = 0.0
        for j in range(len(row)):
            here += row[j] * other[j]
        total += here
    return total


@njit(f"void({_FIELD},{_FIELD},{_TABLE},{_TABLE},{_ROW})", **_OPTIONS)
def wear(change, response, sums, local, swept):
    """Add the depth that a step wears at one position; `swept` has Δx in it."""
    _, nx, ny = change.shape
    lines = np.zeros(ny)
    for i in range(nx):
        c = change[0, i]
        for j in range(ny):
            lines[j] += c[j]
    for j in range(ny):
        lines[j] *= swept[j]
    for i in range(nx):
        c, u, here = change[0, i], response[0, i], local[i]
        for j in range(ny):
            u[j] += here[j] * c[j] + lines[j]
    sums[0, CURVATURE] = _dot(change[0], response[0])


@njit(f"void({_FIELD},{_ROW},i8[:,::1],i8[:,:,::1],{_ROW},b1)", **_OPTIONS)
def gather(fields, shares, bodies, cells, gathered, mirrored):
    """Write the sum of each position's share of a field on each body's own surface.

    The bodies lie one after the other; `bodies` has the first number, rows and columns of each,
    `cells` the row and column at which the window begins, by position.
    """
    count, nx, ny = fields.shape
    gathered[:] = 0.0
    for b in range(len(bodies)):
        first, rows, columns = bodies[b]
        for k in range(count):
            row, column = cells[b, k]
            before = min(ny, columns - column)
            for i in range(nx):
                own, c = gathered[first + (row + i) % rows * columns :], fields[k, i]
                part = own[column : column + before]
                for j in range(before):
                    part[j] += shares[k] * c[j]
                for j in range(before, ny):
                    own[(column + j) % columns] += shares[k] * c[j]
        if mirrored:
            for i in range((rows + 1) // 2):
                own = gathered[first + i * columns :]
                other = gathered[first + (rows - 1 - i) * columns :]
                for j in range(columns):
                    both = own[j] + other[j]
                    own[j], other[j] = both, both


@_compiled(_FIELD, "i8[:,::1]", "i8[:,:,::1]", _ROW)
def scatter(fields, bodies, cells, own, first, last):
    """Add what lies on the bodies' surfaces to fields."""
    _, nx, ny = fields.shape
    for k in range(first, last):
        for b in range(len(bodies)):
            begin, rows, columns = bodies[b]
            row, column = cells[b, k]
            before = min(ny, columns - column)
            for i in range(nx):
                line, u = own[begin + (row + i) % rows * columns :], fields[k, i]
                part = line[column : column + before]
                for j in range(before):
                    u[j] += part[j]
                for j in range(before, ny):
                    u[j] += line[(column + j) % columns]


@_compiled(_FIELD, _FIELD, _TABLE)
def multiply(change, response, sums, first, last):
    """Write the sum of the products of steps and responses."""
    for k in range(first, last):
        sums[k, CURVATURE] = _dot(change[k], response[k])


@njit(f"b1({','.join([_FIELD] * 3)},f8)", **_OPTIONS)
def leaves(pressure, change, limit, part):
    """Whether a part of the step leaves the bounds anywhere."""
    count, nx, ny = pressure.shape
    for k in range(count):
        for i in range(nx):
            p, c, most = pressure[k, i], change[k, i], _most(limit, k, i)
            n = 0
            for j in range(ny):
                n += 1 if _outside(p[j] + part * c[j], most[j]) else 0
            if n > 0:
                return True
    return False


@_inner
def _move(pressure, displacement, limit, change, response, ahead, total, sums, part, k):
    """Take a part of the step."""
    _, nx, ny = pressure.shape
    projected = part == 1.0 and sums[k, MEETS_BOUND] != 0
    for i in range(nx):
        p, u, c, w = pressure[k, i], displacement[k, i], change[k, i], response[k, i]
        there = ahead[k, i]
        for j in range(ny):
            p[j] = there[j] if projected else p[j] + part * c[j]
            u[j] += part * w[j]
    _balance(pressure[k], limit, k, total[k])


@njit(f"void({','.join([_FIELD] * 8)},{_ROW},{_TABLE},f8,i8,i8)", **_OPTIONS)
def arrive(
    pressure,
    displacement,
    gap,
    deformed,
    limit,
    change,
    response,
    ahead,
    total,
    sums,
    part,
    first,
    last,
):
    """Take a part of the step, and judge the pressure there."""
    for k in range(first, last):
        _move(pressure, displacement, limit, change, response, ahead, total, sums, part, k)
        judge(pressure, displacement, gap, deformed, limit, total, sums, k, k + 1)
