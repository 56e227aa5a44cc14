#!/usr/bin/env python3
"""Writes the recordings of this folder: python3 make.py. Equal runs give equal bytes.

They are synthetic, for the valve of `mvs generate`, closed by `mvs close`, with its origin at the
device's origin, at scale 1. The hand is above the atrium (z of the valve is y of the device), x of
the valve is to its right, and the anterior side (y) points away from it (z of the device is -y of
the valve). The grasp takes A2 at vertex 8 of that file, (0, -2.5, -3.2) mm in the valve; the push
meets P2 at vertex 222, (0, -10.1, 0.7). The session also reaches the end of the strut chord A2/7,
(-8.3, 2.7, -2.2).
"""

import math
import os

RATE = 100  # samples per second; the motion of a hand has little content above 10 Hz
A2 = (0.0, -3.2, 2.5)
P2 = (0.0, 0.7, 10.1)
STRUT = (-8.3, -2.2, -2.7)

HEADER = """mvs-recording 1
# {title}
# Synthetic: haptic_drivers/replay/trajectories/make.py.
device Touch
force 3.3
continuous_force 0.88
stiffness 400
damping 4
rate 1000
workspace -0.08 -0.06 -0.08 0.08 0.06 0.08
buttons 2
# time s, position m x y z, orientation w x y z, buttons, gripper rad
"""


def smooth(u):
    """Minimum-jerk reach (Flash and Hogan 1985), at rest at both ends."""
    return u * u * u * (10 + u * (6 * u - 15))


def above(point, mm):
    return (point[0], point[1] + mm, point[2])


def tilt(degrees):
    """Tilt of the stylus to the right, as in a right hand."""
    half = math.radians(degrees) / 2
    return (math.cos(half), 0.0, 0.0, -math.sin(half))


def play(begin, moves):
    """Segments are (seconds, target, buttons, tilt in degrees); an unchanged target is a rest."""
    lines, count, lean = [], 0, moves[0][3]
    for seconds, to, buttons, lean_to in moves:
        steps = round(seconds * RATE)
        for k in range(steps):
            u = smooth(k / steps)
            at = [a + u * (b - a) for a, b in zip(begin, to)]
            lines.append(sample(count, at, tilt(lean + u * (lean_to - lean)), buttons))
            count += 1
        begin, lean = to, lean_to
    lines.append(sample(count, begin, tilt(lean), 0))
    return lines


def sample(count, mm, turn, buttons):
    place = " ".join(f"{x / 1000 + 0:.7f}" for x in mm)
    return f"{count / RATE:.2f} {place} " + " ".join(f"{q + 0:.5f}" for q in turn) + f" {buttons} 0"


def grasp():
    rest = above(A2, 30)
    return play(rest, [
        (0.5, rest, 0, 20), (1.5, A2, 0, 30), (0.3, A2, 0, 30),
        (0.3, A2, 1, 30),  # grasp
        (1.5, above(A2, 10), 1, 35), (1.0, above(A2, 10), 1, 35),  # pull 10 mm, hold
        (1.0, above(A2, 4), 1, 30),
        (0.5, above(A2, 4), 0, 30),  # release
        (1.5, rest, 0, 20), (0.5, rest, 0, 20)])


def push():
    rest, in_touch, deep = above(P2, 30), above(P2, 2), above(P2, -5)
    aside = [(deep[0] + x, deep[1], deep[2]) for x in (6.0, -6.0)]
    return play(rest, [
        (0.5, rest, 0, 20), (1.5, in_touch, 0, 30), (1.0, deep, 0, 30), (0.5, deep, 0, 30),
        (1.0, aside[0], 0, 30), (2.0, aside[1], 0, 30), (1.0, deep, 0, 30),
        (1.0, in_touch, 0, 30), (1.5, rest, 0, 20), (0.5, rest, 0, 20)])


def session():
    rest, over_p2, deep = above(A2, 20), above(P2, 15), above(P2, -5)
    aside = [(deep[0] + x, deep[1], deep[2]) for x in (5.0, -5.0)]
    over_strut, at_strut, below = above(STRUT, 15), above(STRUT, 1), above(STRUT, -12)
    return play(rest, [
        (0.3, rest, 0, 20), (1.0, A2, 0, 30), (0.2, A2, 0, 30), (0.3, A2, 1, 30),  # grasp A2
        (1.0, above(A2, 10), 1, 35), (0.7, above(A2, 10), 1, 35),
        (0.7, above(A2, 3), 1, 30), (0.3, above(A2, 3), 0, 30),  # 4.2 s: let it go
        (1.0, over_p2, 0, 30), (0.5, over_p2, 0, 30),  # to 6.0 s: another tool
        (1.0, deep, 0, 30), (0.3, deep, 0, 30),  # push P2, and slide
        (0.6, aside[0], 0, 30), (1.0, aside[1], 0, 30), (0.6, deep, 0, 30),
        (1.0, over_p2, 0, 30), (0.8, over_strut, 0, 30),  # to 11.3 s: another tool
        (0.7, at_strut, 0, 30), (0.3, at_strut, 1, 30), (0.9, at_strut, 0, 30),  # feel the strut
        (0.1, at_strut, 0, 30), (0.3, at_strut, 1, 30),  # 13.3 s: take its end, another tool
        (1.0, below, 1, 30), (0.4, below, 1, 30), (0.3, below, 0, 30),  # shorten it, 15.0 s: let go
        (1.5, rest, 0, 20), (1.0, rest, 0, 20)])


def circle():
    """Periodic in position and velocity, for option end=loop."""
    lines = []
    for k in range(4 * RATE + 1):
        angle = 2 * math.pi * k / (4 * RATE)
        at = (20 * math.cos(angle), 20 * math.sin(angle), 0)
        lines.append(sample(k, at, tilt(0), 0))
    return lines


def write(name, title, lines):
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), name)
    with open(path, "w", encoding="ascii", newline="\n") as out:
        out.write(HEADER.format(title=title) + "\n".join(lines) + "\n")


write("grasp_a2.txt", "Reaches for A2, grasps it, pulls it 10 mm up, lets go, and leaves.", grasp())
write("push_p2.txt", "Pushes P2 5 mm down, slides 6 mm to both sides, and leaves.", push())
write("session.txt", "Grasps A2, pushes P2, takes the strut A2/7 twice: examples/phantom.c.", session())
write("circle.txt", "A circle of 20 mm radius in 4 s, again and again with end=loop.", circle())
