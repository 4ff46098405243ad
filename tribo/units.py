"""Units for numbers in Python: ``5 * mm`` is a length in m, ``207 * GPa`` a pressure in Pa."""

m = 1.0
km = 1e3
mm = 1e-3
um = 1e-6
nm = 1e-9

N = 1.0
kN = 1e3
mN = 1e-3

Pa = 1.0
kPa = 1e3
MPa = 1e6
GPa = 1e9

s = 1.0
ms = 1e-3
minute = 60.0
hour = 3600.0
Hz = 1.0
kHz = 1e3

kg = 1.0
g = 1e-3
mg = 1e-6
