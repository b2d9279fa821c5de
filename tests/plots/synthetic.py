"""Runs in closed form, as the executables would write them, so that the plots can be tested without an engine."""

import json
import math
import struct
from pathlib import Path

GRAVITY, RESTITUTION, RADIUS, MASS = 9.81, 0.6, 0.5, 2.0

STEPS = ("step,t [s],kinetic [J],potential [J],energy [J],px [kg m/s],py [kg m/s],pz [kg m/s],lx [kg m²/s],ly [kg m²/s],"
         "lz [kg m²/s],contacts,impacts,min_gap [m],max_penetration [m],lcp_rows,lcp_residual,lost_time [s],ccd_ns,lcp_ns,"
         "step_ns")
CONTACTS = ("t [s],body_a,body_b,x [m],y [m],z [m],nx,ny,nz,gap [m],v_before [m/s],v_after [m/s],impulse [N s]")
POSES = ("t [s],body,px [m],py [m],pz [m],qw,qx,qy,qz,vx [m/s],vy [m/s],vz [m/s],wx [rad/s],wy [rad/s],wz [rad/s]")
FEATURES = "query,ax [m],ay [m],az [m],bx [m],by [m],bz [m],nx,ny,nz,gap [m],kind_a,kind_b,id_a,id_b"


def write(file: Path, header: str, rows: list) -> None:
    lines = [header] + [",".join(str(cell) for cell in row) for row in rows]
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")


def bouncing_ball(run: Path, frames: int = 120, dt: float = 1 / 60, height: float = 2.0) -> None:
    """A ball falls on a floor at z = 0 and bounces, each time with RESTITUTION of its speed."""
    run.mkdir(parents=True, exist_ok=True)
    time, z, v = 0.0, height, 0.0
    steps, contacts = [], []
    for frame in range(frames + 1):
        left, impacts, gap = (dt if frame else 0.0), 0, math.inf
        while True:
            until = (v + math.sqrt(v * v + 2 * GRAVITY * (z - RADIUS))) / GRAVITY  # until the floor
            if until > left or until < 1e-9 or impacts == 3:
                break
            v -= GRAVITY * until
            contacts.append((time + until, 0, 1, 0, 0, 0, 0, 0, -1, 1e-7, v, -RESTITUTION * v,
                             -MASS * (1 + RESTITUTION) * v))
            z, v, time, left = RADIUS, -RESTITUTION * v, time + until, left - until
            impacts, gap = impacts + 1, 1e-7
        z, v, time = z + v * left - GRAVITY * left * left / 2, v - GRAVITY * left, time + left
        if z < 2 * RADIUS:
            gap = min(gap, z - RADIUS + 1e-7)
        kinetic, potential = MASS * v * v / 2, MASS * GRAVITY * z
        cost = 20_000 * (1 + 4 * impacts) if frame else 0
        steps.append((frame, time, kinetic, potential, kinetic + potential, 0, 0, MASS * v, 0, 0, 0, impacts, impacts,
                      gap, 0, impacts, 0, 0, cost // 2, cost // 5 if impacts else 0, cost))
    write(run / "steps.csv", STEPS, steps)
    write(run / "contacts.csv", CONTACTS, contacts)
    (run / "summary.json").write_text('{"entries": {"tolerance": {"value": 1e-6, "unit": "m"}}}')


def passing_by(run: Path) -> None:
    """A body that meets nothing, without gravity."""
    run.mkdir(parents=True, exist_ok=True)
    rows = [(k, k / 60, 4, 0, 4, 4, 0, 0, 0, 0, 0, 0, 0, "inf", 0, 0, 0, 0, 1000, 0, 2000) for k in range(61)]
    write(run / "steps.csv", STEPS, rows)
    write(run / "contacts.csv", CONTACTS, [])


def heap(run: Path, frames: int = 300, rests: int = 60, kinds: bool = True, fixed: bool = True) -> None:
    """Bodies that lie 100 m up: `rests` contacts in each frame, one of them with an impulse that is round-off, and in
    every 100th frame an impact. They rise by a joule in a second, and move with 0.01 J."""
    run.mkdir(parents=True, exist_ok=True)
    steps, contacts = [], []
    for frame in range(frames + 1):
        t, impact = frame / 60, int(frame > 0 and frame % 100 == 0)
        steps.append((frame, t, 0.01, 1000 + t, 1000.01 + t, 0, 0, 0, 0, 0, 0, rests, impact if kinds else rests + impact,
                      2e-4, 0, rests, 0, 0, 500, 200, 1000, 1 / 60 if frame else 0))
        if frame < frames:
            contacts += [(t, 0, k, 0, 0, k, 0, 0, 1, 2e-4, -0.16, 0, 1e-15 if k == 1 else 0.01 * k, "rest") for k in range(1, rests + 1)]
        if impact:
            contacts.append((t - 0.001, 0, 1, 0, 0, 0, 0, 0, 1, 1e-7, -2, 1, 7, "impact"))
    write(run / "steps.csv", STEPS + ",correction_energy [J]", steps)
    write(run / "contacts.csv", CONTACTS + ",kind" if kinds else CONTACTS, contacts if kinds else [row[:-1] for row in contacts])
    (run / "summary.json").write_text('{"entries": {"tolerance": {"value": 1e-6}, "envelope": {"value": 0.0005}}}')
    motion(run / "motion.glb", fixed)


def motion(file: Path, fixed: bool) -> None:
    """As much of a recorded motion as plots read: the nodes."""
    text = json.dumps({"nodes": [{"name": "world"}, {"name": "body_0", "extras": {"static": fixed}}]}).encode()
    file.write_bytes(struct.pack("<4sIII4s", b"glTF", 2, 20 + len(text), len(text), b"JSON") + text)


def one_solve(run: Path) -> None:
    """Contacts of a single instant."""
    run.mkdir(parents=True, exist_ok=True)
    rows = [(0, 0, 1, k, 0, 0, 0, 0, 1, 0, -1, 0.5 * (k % 2), 10.0 ** (k - 2)) for k in range(6)]
    write(run / "contacts.csv", CONTACTS, rows)


def queries(run: Path) -> None:
    """First contacts of queries."""
    run.mkdir(parents=True, exist_ok=True)
    kinds = ("vertex", "edge", "face")
    rows = [(k, 0, 0, 0, 0, 0, 1e-7, 0, 0, 1, 1e-7 * (1 + k % 7), kinds[k % 3], kinds[k % 2], k, k) for k in range(40)]
    write(run / "features.csv", FEATURES, rows)


def cube(file: Path, middle: tuple[float, float, float], parts: int = 12) -> None:
    """A cube of edge 2 as an OBJ; each of its sides is divided into parts by parts squares."""
    lines, count = [], 0
    for axis in range(3):
        for side in (-1, 1):
            for row in range(parts + 1):
                for column in range(parts + 1):
                    point = [0.0, 0.0, 0.0]
                    point[axis], point[axis - 2], point[axis - 1] = side, 2 * row / parts - 1, 2 * column / parts - 1
                    lines.append("v " + " ".join(str(x + c) for x, c in zip(point, middle)))
            for row in range(parts):
                for column in range(parts):
                    a = count + row * (parts + 1) + column + 1
                    b, c, d = a + parts + 1, a + parts + 2, a + 1
                    lines += [f"f {a} {b} {c}", f"f {a} {c} {d}"] if side > 0 else [f"f {a} {c} {b}", f"f {a} {d} {c}"]
            count += (parts + 1) ** 2
    file.write_text("\n".join(lines) + "\n")


def two_cubes(run: Path) -> None:
    """The first of two cubes comes with 2 m/s, passes all it has to the other at t = 0.75 s, and stops."""
    run.mkdir(parents=True, exist_ok=True)
    rows = []
    for frame in range(13):
        t = frame / 8
        before, after = min(t, 0.75), max(0.0, t - 0.75)
        rows.append((t, 0, -3 + 2 * before, 0, 0, 1, 0, 0, 0, 0 if after else 2, 0, 0, 0, 0, 0))
        rows.append((t, 1, 0.5 + 2 * after, 0, 0, 1, 0, 0, 0, 2 if after else 0, 0, 0, 0, 0, 0))
    write(run / "poses.csv", POSES, rows)
    contact = (0.75, 0, 1, -0.5, 0, 0, 1, 0, 0, 0, -2, 2, 4)
    write(run / "contacts.csv", CONTACTS, [contact[:4] + (y, z) + contact[6:] for y in (-1, 1) for z in (-1, 1)])
