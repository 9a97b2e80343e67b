#!/usr/bin/env python3
"""Numbers of monodromy_test.cpp, by SciPy (DOP853 at 1e-13), in axes that do not turn.

Tilt phi = phi_x + i phi_y of a rigid rotor with unequal inertias between two like bearings
(docs/theory.md, section "Rotating frame", seen from the fixed axes):

    A phi'' - i W C phi' + a e^(2iWt) conj(phi'' - 2iW phi') + k phi_x + i k' phi_y + c phi' = 0
"""
import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq


def growth(speed, A, C, a, kx, ky, c):
    """Largest growth, 1/s, of the four motions over half a turn."""

    def rate(t, flat):
        state = flat.reshape(4, 4)
        x, v = state[:2], state[2:]
        e = a * np.exp(2j * speed * t)
        mass = np.array([[A + e.real, e.imag], [e.imag, A - e.real]])
        f = 2j * speed * e
        turning = np.array([[f.real, f.imag], [f.imag, -f.real]])
        gyroscopic = np.array([[0, -speed * C], [speed * C, 0]])
        force = gyroscopic @ v - turning @ v - np.diag([kx, ky]) @ x - c * v
        return np.vstack([v, np.linalg.solve(mass, force)]).ravel()

    period = np.pi / abs(speed)
    end = solve_ivp(rate, (0, period), np.eye(4).ravel(), method="DOP853", rtol=1e-13, atol=1e-15)
    multipliers = np.linalg.eigvals(end.y[:, -1].reshape(4, 4))
    return np.log(np.abs(multipliers)).max() / period


def show(name, rotor, speeds, brackets):
    for speed in speeds:
        print(name, "growth at", speed, growth(speed, *rotor))
    for low, high in brackets:
        print(name, "end", brentq(lambda speed: growth(speed, *rotor), low, high, xtol=1e-9))


if __name__ == "__main__":
    show("hill_rotor", (0.8, 0.5, 0.08, 2e5, 3e5, 10), (250.0, 600.0, 920.0, 1300.0),
         ((815, 822), (1066, 1072)))
    show("ninefold", (0.8, 0.5, 0.24, 0.5e5, 4.5e5, 0.25), (31.0, 100.0, 173.505, 230.0),
         ((173.40, 173.505), (173.505, 173.65), (224.2, 230.0), (230.0, 240.2)))
