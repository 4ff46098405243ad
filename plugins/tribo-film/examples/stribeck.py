"""A Stribeck curve: friction and wear over the speed of a ball of 5 mm on a flat, under 100 N."""

from tribo_film.hamrock_dowson import central_film
from tribo_film.mixed import Mixed

FILM = Mixed(viscosity="0.1 Pa s", pressure_viscosity="20 1/GPa", radius="5 mm", roughness="0.2 um")
MODULUS = 207e9 / (2 * (1 - 0.3**2))
SPEEDS = (1e-4, 1e-3, 1e-2, 0.1, 0.3, 1.0, 3.0, 10.0)


def curve() -> list[tuple[float, float, float, float]]:
    """Return speed in m/s, Λ, coefficient of friction and wear beside that without film."""
    rows = []
    for speed in SPEEDS:
        thickness = central_film(
            FILM.radius, 100.0, 0.5 * speed, FILM.viscosity, FILM.pressure_viscosity, MODULUS
        )
        ratio = thickness / FILM.roughness
        rows.append((speed, ratio, FILM.friction(ratio), 1 - FILM.share(ratio)))
    return rows


if __name__ == "__main__":
    print(f"{'speed, m/s':>10}{'Λ':>10}{'friction':>12}{'wear':>12}")
    for speed, ratio, coefficient, part in curve():
        print(f"{speed:10.3g}{ratio:10.3g}{coefficient:12.3f}{part:12.3g}")
