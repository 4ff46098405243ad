"""The passes of an iteration over cells, compiled; importing them compiles or loads them.

A long pass serves the positions `first` to `last`, so that threads share them; to hand a part to a
thread takes 50 µs. A pass leaves its sums of each position in a row of `sums`: what is added over
the positions is added there in their order, with the same bits for any number of threads. Fields
have the shape (positions, nx, ny); the largest pressure has it too, or one row for all cells.
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
    LIST,
    LISTED,
) = range(16)
"""Columns of `sums`."""
HELD, OPEN, MOST, RESIDUAL, GRADIENT, DIRECTION, STEP, AHEAD, FIELDS = range(9)
"""Fields of the listed cells: pressure, deformed gap, largest pressure, residual, the residual
before, direction, step (which the preconditioned residual is first), end of a projected step."""
_BLOCK = 16
"""Cells of a row that are looked at together: only where one is listed, each of them is."""
_COLUMNS = 1 << 12
"""Complex numbers of the lines that are transformed at a time: 64 KiB, as was fastest."""
_ROUND_OFF = 1e-15
"""A few units of rounding: a sum is no more exact; as in the kernel's projection."""
_NEAR = 1e-12
"""Good enough for `_balance` to correct; as in the kernel's projection."""
_LINES = np.array([1])
"""The axis of a line."""

_FIELD, _TABLE, _ROW, _MODES = "f8[:,:,::1]", "f8[:,::1]", "f8[::1]", "c16[:,::1]"
# Pressure, displacement, gap, largest pressure, step and response; listed cells, fields and sums.
_PLACE = f"UniTuple({_FIELD},6)"
_LISTS = f"Tuple((u4[:,:,::1],f8[:,:,:,::1],{_TABLE}))"
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
    return np.zeros((positions, LISTED + 1))


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
def _listed(lists, k):
    """Return the listed cells of a position, their fields, and how many there are."""
    cells, fields, sums = lists
    now = int(sums[k, LIST])
    return cells[now, k], fields[now, k], int(sums[k, LISTED])


@_inner
def _sum(values):
    """Return a sum, of sums of parts: one after the other would gather round-off."""
    total = 0.0
    for first in range(0, len(values), 64):
        here = 0.0
        for value in values[first : first + 64]:
            here += value
        total += here
    return total


@_inner
def _scatter(values, cells, count, field):
    into = field.ravel()
    for s in range(count):
        into[cells[s]] = values[s]


@_inner
def _list(place, lists, part, approach, k):
    """Take a part of the response, and list the cells that are pressed or overlap.

    Cells keep their direction, and their residual as the one before; `change` is cleared.
    """
    (pressure, displacement, gap, limit, change, response), sums = place, lists[2]
    _, nx, ny = pressure.shape
    old, known, before = _listed(lists, k)
    sums[k, LIST] = 1 - sums[k, LIST]
    c, f, _ = _listed(lists, k)
    held, opened, most = f[HELD], f[OPEN], f[MOST]
    n = 0
    for i in range(nx):
        p, u, h, w = pressure[k, i], displacement[k, i], gap[k, i], response[k, i]
        for j in range(ny):
            u[j] += part * w[j]
        for first in range(0, ny, _BLOCK):
            q, v, g = p[first:][:_BLOCK], u[first:][:_BLOCK], h[first:][:_BLOCK]
            found = 0
            for j in range(len(q)):
                found += 1 if (q[j] > 0) | (v[j] + g[j] < approach) else 0
            if found == 0:
                continue
            row = _most(limit, k, i)
            for j in range(len(q)):
                if (q[j] > 0) | (v[j] + g[j] < approach):
                    c[n], most[n] = i * ny + first + j, row[first + j]
                    held[n], opened[n] = q[j], v[j] + g[j] - approach
                    n += 1
    sums[k, LISTED] = n
    steps = change[k].ravel()
    for o in range(before):
        steps[old[o]] = 0.0
    o = 0
    for s in range(n):
        while o < before and old[o] < c[s]:
            o += 1
        same = o < before and old[o] == c[s]
        f[DIRECTION, s] = known[DIRECTION, o] if same else 0.0
        f[GRADIENT, s] = known[RESIDUAL, o] if same else 0.0


@_inner
def _approach_at_bounds(pressure, displacement, gap, response, part):
    """Return the approach where no cell is between the bounds: any value between the two."""
    highest, lowest = -np.inf, np.inf
    for i in range(len(pressure)):
        for j in range(pressure.shape[1]):
            deformed = displacement[i, j] + part * response[i, j] + gap[i, j]
            if pressure[i, j] > 0:
                highest = max(highest, deformed)
            else:
                lowest = min(lowest, deformed)
    return 0.5 * (highest + lowest) if lowest < np.inf else highest


@_inner
def _judge(place, lists, total, part, k):
    """Take a part of the response, and find the approach, the cells to list and the residuals."""
    pressure, displacement, gap, _, _, response = place
    sums = lists[2]
    c, f, n = _listed(lists, k)
    p, most = f[HELD], f[MOST]
    u, g, w = displacement[k].ravel(), gap[k].ravel(), response[k].ravel()
    between, level, lowest, highest, deepest = 0, 0.0, np.inf, -np.inf, -np.inf
    for s in range(n):
        if p[s] > 0:
            v, h = u[c[s]] + part * w[c[s]], g[c[s]]
            lowest, highest, deepest = min(lowest, h), max(highest, h), max(deepest, v)
            free = p[s] < most[s]
            between += 1 if free else 0
            level += v + h if free else 0.0
    if between:
        approach = level / between
    else:
        approach = _approach_at_bounds(pressure[k], displacement[k], gap[k], response[k], part)
    _list(place, lists, part, approach, k)
    _, f, n = _listed(lists, k)
    p, d, most = f[HELD], f[OPEN], f[MOST]
    opening, face, mean, below = 0.0, 0, 0.0, 0.0
    for s in range(n):
        opening += p[s] * abs(d[s]) if (p[s] < most[s]) | (d[s] > 0) else 0.0
        on = _on_face(p[s], d[s], most[s])
        face += 1 if on else 0
        mean += d[s] if on else 0.0
    for s in range(n):
        below = min(below, 0.0 if p[s] > 0 else d[s])
    scale = max(deepest, highest - lowest)
    scale = 1.0 if scale == 0 else scale
    sums[k, FORCE] = abs(_sum(p[:n]) / total[k] - 1.0)
    sums[k, OPENING] = opening / (total[k] * scale)
    sums[k, PENETRATION] = 0.0 - below / scale
    sums[k, APPROACH] = approach
    sums[k, FACE], sums[k, MEAN] = max(face, 1), mean / max(face, 1)


@_compiled(_PLACE, _LISTS, _ROW)
def judge(place, lists, total, first, last):
    """List the cells of any pressure, and judge it; the response does not count."""
    for k in range(first, last):
        _list(place, lists, 0.0, -np.inf, k)
        _judge(place, lists, total, 0.0, k)


@_compiled(_FIELD, _FIELD, _LISTS, _TABLE, _MODES, _TABLE)
def precondition(change, z, lists, spectrum, modes, lines, first, last):
    """Centre the residual on the face, and convolve it; it lies in `change`."""
    for k in range(first, last):
        c, f, n = _listed(lists, k)
        p, d, most, r = f[HELD], f[OPEN], f[MOST], f[RESIDUAL]
        mean = lists[2][k, MEAN]
        for s in range(n):
            r[s] = d[s] - mean if _on_face(p[s], d[s], most[s]) else 0.0
        _scatter(r, c, n, change[k])
        _convolve(change[k], z[k], spectrum, modes, lines)


@njit(f"void({_FIELD},{_LISTS})", **_OPTIONS)
def steepen(z, lists):
    """Take the preconditioned residual from a field, and find its sums."""
    sums = lists[2]
    for k in range(len(z)):
        c, f, n = _listed(lists, k)
        p, d, most, w = f[HELD], f[OPEN], f[MOST], f[STEP]
        r, g, v = f[RESIDUAL], f[GRADIENT], f[DIRECTION]
        preconditioned = z[k].ravel()
        for s in range(n):
            w[s] = preconditioned[c[s]]
        # The sums of the centred z: the residual is centred already.
        raised, turned, past, steepness, overlap = 0.0, 0.0, 0.0, 0.0, 0.0
        for s in range(n):
            on = _on_face(p[s], d[s], most[s])
            raised += w[s] if on else 0.0
            turned += v[s] if on else 0.0
            past += g[s] if on else 0.0
            overlap += w[s] * g[s] if on else 0.0
            steepness += w[s] * r[s]
        sums[k, RAISED], sums[k, TURNED] = raised / sums[k, FACE], turned / sums[k, FACE]
        sums[k, STEEPNESS], sums[k, OVERLAP] = steepness, overlap - sums[k, RAISED] * past


@_inner
def _turn(lists, beta, length, k):
    """Turn the direction, all of it centred, and see whether a step along it meets a bound."""
    (_, f, n), sums = _listed(lists, k), lists[2]
    p, d, most, r, v, w = f[HELD], f[OPEN], f[MOST], f[RESIDUAL], f[DIRECTION], f[STEP]
    raised, turned = sums[k, RAISED], sums[k, TURNED]
    along, downhill, beyond = 0.0, 0.0, 0
    for s in range(n):
        on = _on_face(p[s], d[s], most[s])
        v[s] = beta * (v[s] - turned) - (w[s] - raised) if on else 0.0
        along += v[s] * r[s]
        downhill += v[s] * d[s]
        beyond += 1 if _outside(p[s] + length * v[s], most[s]) else 0
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
def _balance(pressure, most, count, total):
    """Remove the round-off in the sum of a pressure: cells between the bounds change alike."""
    for _ in range(2):
        between = 0
        for s in range(count):
            between += 1 if (pressure[s] > 0) & (pressure[s] < most[s]) else 0
        missing = total - _sum(pressure[:count])
        if abs(missing) <= _ROUND_OFF * total or between == 0:
            break
        missing /= between
        for s in range(count):
            free = (pressure[s] > 0) & (pressure[s] < most[s])
            pressure[s] = min(max(pressure[s] + (missing if free else 0.0), 0.0), most[s])


@_inner
def _step(lists, total, length, k):
    """Write the step, and where it ends at a position at which it is projected onto a bound."""
    (_, f, n), (_, fields, sums) = _listed(lists, k), lists
    p, d, most, v, c, there = f[HELD], f[OPEN], f[MOST], f[DIRECTION], f[STEP], f[AHEAD]
    if sums[k, MEETS_BOUND] == 0:
        for s in range(n):
            c[s] = length * v[s]
        return
    # The list before is of no more use.
    values, tops = fields[1 - int(sums[k, LIST]), k, :2]
    count = 0
    for s in range(n):
        on = _on_face(p[s], d[s], most[s])
        there[s] = 0.0 if on else p[s]
        if on:
            values[count], tops[count] = p[s] + length * v[s], most[s]
            count += 1
    shift = _shift(values[:count], total[k] - _sum(there[:n]), tops[:count])
    for s in range(n):
        moved = min(max(p[s] + length * v[s] + shift, 0.0), most[s])
        there[s] = moved if _on_face(p[s], d[s], most[s]) else p[s]
    _balance(there, most, n, total[k])
    slope = 0.0
    for s in range(n):
        c[s] = there[s] - p[s]
        slope += c[s] * d[s]
    sums[k, SLOPE] = slope


@_compiled(_FIELD, _FIELD, _LISTS, _ROW, "f8", "f8", _TABLE, _MODES, _TABLE)
def advance(change, response, lists, total, beta, length, spectrum, modes, lines, first, last):
    """Turn the direction, step along it, and write the response."""
    for k in range(first, last):
        _turn(lists, beta, length, k)
        _step(lists, total, length, k)
        c, f, n = _listed(lists, k)
        _scatter(f[STEP], c, n, change[k])
        lists[2][k, CURVATURE] = _convolve(change[k], response[k], spectrum, modes, lines)


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


@njit(f"void({_FIELD},i8[:,::1],i8[:,:,::1],{_ROW})", **_OPTIONS)
def scatter(fields, bodies, cells, own):
    """Add what lies on the bodies' surfaces to fields."""
    count, nx, ny = fields.shape
    for k in range(count):
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


@njit(f"void({_FIELD},{_FIELD},{_TABLE})", **_OPTIONS)
def multiply(change, response, sums):
    """Write the sum of the products of steps and responses."""
    for k in range(len(change)):
        sums[k, CURVATURE] = _dot(change[k], response[k])


@njit(f"b1({_LISTS},f8)", **_OPTIONS)
def leaves(lists, part):
    """Whether a part of the step leaves the bounds anywhere."""
    for k in range(len(lists[2])):
        _, f, n = _listed(lists, k)
        p, c, most = f[HELD], f[STEP], f[MOST]
        beyond = 0
        for s in range(n):
            beyond += 1 if _outside(p[s] + part * c[s], most[s]) else 0
        if beyond > 0:
            return True
    return False


@_compiled(_PLACE, _LISTS, _ROW, "f8")
def arrive(place, lists, total, part, first, last):
    """Take a part of the step, and judge the pressure there."""
    for k in range(first, last):
        c, f, n = _listed(lists, k)
        p, step, there = f[HELD], f[STEP], f[AHEAD]
        projected = part == 1.0 and lists[2][k, MEETS_BOUND] != 0
        for s in range(n):
            p[s] = there[s] if projected else p[s] + part * step[s]
        _balance(p, f[MOST], n, total[k])
        _scatter(p, c, n, place[0][k])
        _judge(place, lists, total, part, k)
