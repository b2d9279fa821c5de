"""Chapter 3's drawings: what one contact after the other gets wrong, a contact and its row, the matrix, complementarity, a drive,
a proof, the residual, and four methods on one problem.

Reads the tables that ch03_pictures writes into RUN_DIR. Writes one picture for each name into the folder --out.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import numpy as np

from drawing_program import draw
from sketch import DARK, PALE, arrow, ball, bare, body, box, note
from style import BLUE, GREEN, GREY, ORANGE, RED, SKY, Table, plt

FLOOR = "#D8D8D8"


def ground(axes, x0: float, x1: float, top: float = 0, depth: float = 0.12) -> None:
    body(axes, [[x0, top - depth], [x1, top - depth], [x1, top], [x0, top]], FLOOR, "none")
    axes.plot([x0, x1], [top, top], color=DARK, lw=1.1)


def fraction(value: float) -> str:
    """A multiple of 1/8 as a fraction: −5/8."""
    eighths = round(8 * value)
    if abs(8 * value - eighths) > 1e-6:
        return f"{value:.2f}".replace("-", "−")
    divisor = np.gcd(eighths, 8)
    over, under = abs(eighths) // divisor, 8 // divisor
    return ("−" if eighths < 0 else "") + (f"{over}" if under == 1 else f"{over}/{under}")


# -- one by one -------------------------------------------------------------------------------------------------

def one_by_one(run: Path):
    table = Table(run / "one_by_one.csv")
    scene, order = table.text("scene"), table.text("order")
    velocity, spin = table.vectors("vx", "vz"), table["spin"]

    def rows(which: str, how: str) -> list[int]:
        return [k for k in range(len(table)) if scene[k] == which and order[k] == how]

    figure, axes = plt.subplots(2, 4, figsize=(8.6, 3.9), height_ratios=(1.25, 1))
    orders = ("left first", "right first", "at once")
    titles = ("one by one,\nleft first", "one by one,\nright first", "all at once")
    # The box, some time after it has left the floor; the dashed outline is where it touched.
    later = 0.32
    for panel, how, title in zip(axes[0], (None, *orders), ("a box lands flat", *titles)):
        bare(panel, title)
        ground(panel, -0.95, 0.95)
        if how is None:
            body(panel, box((0, 0.5), (1, 1)))
            for x in (-0.5, 0.5):
                arrow(panel, (x, 0.52), (x, 0.08), BLUE)
            note(panel, (0, 0.72), "2 m/s down", BLUE)
        else:
            k = rows("box", how)[1]
            body(panel, box((0, 0.5), (1, 1)), "none", GREY, ls="--", lw=0.8)
            # The spin is about y, which points into the picture: a positive one turns clockwise here.
            centre = np.array([0, 0.5]) + later * velocity[k]
            body(panel, box(centre, (1, 1), -later * spin[k]))
            arrow(panel, centre, centre + 0.4 * velocity[k], BLUE)
            turn = "level" if abs(spin[k]) < 1e-9 else f"spin {abs(spin[k]):.2f} rad/s"
            note(panel, (0, -0.28), turn, GREEN if turn == "level" else RED)
        panel.set(xlim=(-1, 1), ylim=(-0.42, 1.6))
    # Three balls, with their velocities below.
    start = np.array([2, 0, -1])
    for panel, how in zip(axes[1], (None, *orders)):
        bare(panel)
        speeds = start if how is None else velocity[rows("balls", how), 0]
        for b, speed in enumerate(speeds):
            centre = np.array([1.15 * b, 0])
            ball(panel, centre, 0.5, "#C9C9C9" if b == 1 else PALE)
            note(panel, centre - [0, 0.02], f"{(1, 2, 1)[b]} kg", fontsize=8)
            if abs(speed) > 1e-9:
                arrow(panel, centre + [-0.28 * speed, 0.75], centre + [0.28 * speed, 0.75], BLUE)
            else:
                panel.plot(*(centre + [0, 0.75]), "o", ms=3.5, color=BLUE)
            note(panel, centre - [0, 0.82], fraction(speed), BLUE)
        panel.set(xlim=(-0.7, 3), ylim=(-1.35, 1.1))
    note(axes[1][0], (1.15, -1.2), "m/s, to the right", BLUE, fontsize=8.5)
    return figure


# -- a contact ------------------------------------------------------------------------------------------------

def contact(run: Path):
    table = Table(run / "contact.csv")
    named = {name: np.array([x, z]) for name, x, z in zip(table.text("name"), table["x"], table["z"])}
    p, n, a, b = named["p"], named["n"], named["c_A"], named["c_B"]
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.6, 3.9), width_ratios=(1.25, 1))
    bare(left)
    ball(left, a, 0.5)
    # The stick: its centre and its lower end are known; half as thick as a tenth of its length.
    along = b - p
    body(left, box(0.5 * (p + p + 2 * along), (2 * np.linalg.norm(along), 0.07), np.arctan2(along[1], along[0])))
    for centre, name, at in ((a, "$c_A$", (-0.11, -0.08)), (b, "$c_B$", (0.12, -0.07))):
        left.plot(*centre, "o", ms=4, color=DARK)
        note(left, centre + at, name)
    arrow(left, a, p, GREY, 1.2)
    note(left, 0.5 * (a + p) + [-0.09, 0.05], "$r_A$", GREY, fontsize=10)
    arrow(left, b, p, GREY, 1.2)
    note(left, 0.5 * (b + p) + [0.1, -0.06], "$r_B$", GREY, fontsize=10)
    tangent = np.array([n[1], -n[0]])
    left.plot(*np.array([p - 0.5 * tangent, p + 0.5 * tangent]).T, color=GREY, lw=0.8, ls=(0, (4, 3)))
    arrow(left, p, p + 0.48 * n, BLUE, 2)
    note(left, p + 0.52 * n + [-0.02, 0.07], "$n$", BLUE, fontsize=11)
    for sign, name, at in ((1, "+j n on B", (-0.06, 0.02)), (-1, "−j n on A", (-0.02, -0.09))):  # beside n, so that both are seen
        side = p - sign * 0.035 * tangent
        arrow(left, side, side + sign * 0.3 * n, ORANGE, 2)
        note(left, side + sign * 0.3 * n + at, name, ORANGE, ha="right" if sign > 0 else "left")
    left.plot(*p, "o", ms=5, color=RED, zorder=5)
    note(left, p + [-0.13, 0.02], "$p$", RED, fontsize=11)
    arrow(left, b, b + 0.22 * named["v_B"], SKY)
    note(left, b + 0.22 * named["v_B"] + [0.17, 0.06], "velocity\nof $c_B$", SKY, ha="left", fontsize=9)
    note(left, (0, -0.3), "A, at rest")
    note(left, p + 2 * along + [-0.02, 0.1], "B")
    left.set(xlim=(-0.6, 1.55), ylim=(-0.62, 1.4))
    bare(right, "its row, from the code", equal=False)
    speed, mass_term = named["a, v"][1], named["a, v"][0]
    lines = [("point p", f"({p[0]:.2f}, {p[1]:.2f}) m"), ("normal n, from A to B", f"({n[0]:.2f}, {n[1]:.2f})"),
             ("r × n on A", f"{abs(named['r_A x n'][1]):.2f} m"), ("r × n on B", f"{named['r_B x n'][1]:.2f} m"),
             ("speed of separation v", f"{speed:.2f} m/s"), ("answer a to 1 N s", f"{mass_term:.2f} /kg")]
    for k, (what, text) in enumerate(lines):
        y = 0.92 - 0.165 * k
        note(right, (0.0, y), what, GREY, ha="left")
        note(right, (0.52, y), text.replace("-", "−"), DARK, ha="left", fontsize=10)
    right.set(xlim=(0, 1), ylim=(0, 1))
    return figure


# -- the matrix -------------------------------------------------------------------------------------------------

def matrix_of(run: Path, scene: str) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    table = Table(run / "problems.csv")
    rows = [k for k, name in enumerate(table.text("scene")) if name == scene]
    return table.vectors("A 1", "A 2")[rows], table["b"][rows], table["z"][rows], table["y"][rows]


def matrix(run: Path):
    a, _, _, _ = matrix_of(run, "balls")
    figure, axes = plt.subplots(1, 2, figsize=(8.6, 2.5))
    for pushed, panel in enumerate(axes):
        bare(panel, f"1 N s at contact {pushed + 1}: column {pushed + 1} of $A$")
        for b in range(3):
            ball(panel, (1.3 * b, 0), 0.5, "#C9C9C9" if b == 1 else PALE)
            note(panel, (1.3 * b, 0), f"{(1, 2, 1)[b]} kg", fontsize=8.5)
        left, right = 1.3 * pushed, 1.3 * pushed + 1.3
        arrow(panel, (left + 0.65, 0.68), (left + 0.1, 0.68), ORANGE, 2)
        arrow(panel, (right - 0.65, 0.68), (right - 0.1, 0.68), ORANGE, 2)
        for i in range(2):
            x = 1.3 * i + 0.65
            value = a[i, pushed]
            panel.plot([x, x], [-0.6, 0.6], color=GREY, lw=0.8, ls=(0, (3, 3)))
            note(panel, (x, -0.78), f"{value:+.1f} m/s".replace("-", "−"), BLUE if value > 0 else RED)
            note(panel, (x, -1.03), "opens" if value > 0 else "closes", BLUE if value > 0 else RED, fontsize=8.5)
        panel.set(xlim=(-0.7, 3.3), ylim=(-1.2, 0.95))
    return figure


# -- complementarity ------------------------------------------------------------------------------------------------

def cone(axes, u, v, colour: str, reach: float) -> None:
    """All sums of the two directions, drawn as far as `reach`."""
    u, v = np.asarray(u, float) / np.linalg.norm(u), np.asarray(v, float) / np.linalg.norm(v)
    angles = np.linspace(0, 1, 40)
    rim = np.array([(1 - s) * u + s * v for s in angles])
    rim *= reach / np.linalg.norm(rim, axis=1)[:, None]
    axes.fill(*np.vstack([[0, 0], rim]).T, color=colour, alpha=0.28, lw=0)


def cones_of(axes, a: np.ndarray, reach: float) -> None:
    e, minus = np.eye(2), -a.T
    for u, v, colour in ((e[0], e[1], GREY), (minus[0], e[1], SKY), (e[0], minus[1], ORANGE), (minus[0], minus[1], BLUE)):
        if abs(np.linalg.det(np.array([u, v]))) > 1e-12:
            cone(axes, u, v, colour, reach)
    for direction, name in ((e[0], "$e_1$"), (e[1], "$e_2$"), (minus[0], "$-A_1$"), (minus[1], "$-A_2$")):
        end = direction / np.linalg.norm(direction)
        arrow(axes, (0, 0), 0.92 * reach * end, DARK, 1.3)
        note(axes, 1.06 * reach * end, name, fontsize=10)


def cones(run: Path):
    a, b, z, _ = matrix_of(run, "balls")
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.6, 3.9), width_ratios=(1, 1.25))
    bare(left, "one row: one of the two is 0")
    arrow(left, (0, 0), (1.25, 0), DARK, 1)
    arrow(left, (0, 0), (0, 1.25), DARK, 1)
    note(left, (1.27, -0.1), "zᵢ, impulse", ha="right", va="top")
    note(left, (0.04, 1.27), "wᵢ, speed beyond the law", ha="left")
    left.plot([0, 0, 1.12], [1.12, 0, 0], color=BLUE, lw=4.5, solid_capstyle="round", solid_joinstyle="round", zorder=5)
    note(left, (0.07, 0.72), "separates:\nno push", BLUE, ha="left")
    note(left, (0.62, 0.14), "pushes: no more speed", BLUE)
    note(left, (0.72, 0.5), "pushes\nthough it separates:\nnot allowed", RED, fontsize=8.5)
    left.set(xlim=(-0.25, 1.4), ylim=(-0.3, 1.4))
    bare(right, "two rows: who pushes, for every $b$")
    cones_of(right, a, 3.5)
    for where, text, colour in (((1.7, 1.7), "nobody pushes", DARK), ((-1.75, 1.9), "only contact 1\npushes", DARK),
                                ((1.9, -1.6), "only contact 2\npushes", DARK), ((-1.05, -2.35), "both push", DARK)):
        note(right, where, text, colour)
    right.plot(*b, "o", ms=7, color=RED, zorder=6)
    note(right, b + [-0.1, -0.42], f"our b = ({b[0]:g}, {b[1]:g})".replace("-", "−"), RED)
    right.set(xlim=(-4.7, 4.3), ylim=(-4.1, 4.0))
    return figure


# -- residual -------------------------------------------------------------------------------------------------

def residual(run: Path):
    table = Table(run / "paths.csv")
    a, _, _, _ = matrix_of(run, "balls")
    scale = np.abs(a).max(axis=1)
    sweeps = [k for k, (m, s) in enumerate(zip(table.text("method"), table["step"])) if m == "pgs" and s in (1, 2)]
    z, w = table.vectors("z1", "z2"), table.vectors("w1", "w2")
    figure, axes = plt.subplots(1, 2, figsize=(8.6, 3.0))
    for panel, k in zip(axes, sweeps):
        panel.plot([0, 0, 5], [1.2, 0, 0], color=BLUE, lw=3.5, solid_joinstyle="round")
        for i, colour in enumerate((ORANGE, GREEN)):
            x, y = scale[i] * z[k, i], w[k, i]
            off = min(x, y, key=abs)
            panel.plot(x, y, "o", ms=7, color=colour)
            note(panel, (x, 0.15 if y > -0.3 else y - 0.16), f"row {i + 1}", colour)
            if abs(off) > 1e-9:
                if abs(off) > 0.3:
                    arrow(panel, (x, y), (x, 0), RED, 1.4, "<|-|>", shrinkA=4)
                note(panel, (x + 1.8, min(y / 2, -0.3)), f"min(s z, w) = {off:.2f} m/s".replace("-", "−"), RED)
        panel.set(xlim=(-0.3, 7.4), ylim=(-1.15, 1.35), xlabel="sᵢ zᵢ [m/s]")
        panel.set_title(f"after sweep {table['step'][k]:.0f}: residual {table['residual'][k]:.3f}")
    axes[0].set_ylabel("wᵢ [m/s]")
    return figure


# -- a drive ------------------------------------------------------------------------------------------------------

def drive(run: Path):
    table = Table(run / "drive.csv")
    t, z1, w1, w2 = (table[name] for name in ("z2", "z1", "w1", "w2"))
    leaves = t[np.argmax(z1 <= 0)]
    figure, (top, low) = plt.subplots(1, 2, figsize=(8.6, 3.7), width_ratios=(1, 1.5))
    bare(top, "a plank lands on two posts")
    body(top, box((0, 0.1), (3, 0.2)))
    for k, x in enumerate((-1.3, -0.4)):
        body(top, [[x - 0.07, -0.9], [x + 0.07, -0.9], [x + 0.07, 0], [x - 0.07, 0]], FLOOR)
        note(top, (x, -1.06), f"post {k + 1}")
    top.plot(0, 0.1, "o", ms=4, color=DARK)
    note(top, (0.05, -0.16), "centre", fontsize=8.5)
    for x in (-1.3, -0.4, 0.5, 1.3):
        arrow(top, (x, 0.85), (x, 0.3), BLUE)
    note(top, (0, 1.02), "1 m/s down", BLUE)
    top.set(xlim=(-1.65, 1.65), ylim=(-1.25, 1.2))
    low.plot(t, z1, color=ORANGE)
    low.plot(t, w1, color=SKY)
    low.plot(t, w2, color=BLUE, lw=2.2)
    low.axhline(0, color=DARK, lw=0.7)
    for x, text in ((leaves, "z₁ falls to 0:\nrow 1 leaves the basis"), (t[-1], "w₂ reaches 0:\nrow 2 enters")):
        low.axvline(x, color=RED, lw=0.9, ls=(0, (4, 3)))
        low.text(x - 0.015, 1.02, text, color=RED, fontsize=8.5, ha="right", va="top")
        low.plot(x, 0, "o", ms=6, color=RED, zorder=5)
    note(low, (0.2, 0.43), "$z_1$", ORANGE, fontsize=10)
    note(low, (1.02, 0.33), "$w_1$", SKY, fontsize=10)
    note(low, (0.3, -0.53), "$w_2$", BLUE, fontsize=10)
    low.set(xlabel="z₂ [N s], raised from 0", ylabel="z [N s], w [m/s]", xlim=(0, 1.3), ylim=(-0.8, 1.08))
    low.set_title("the drive of row 2")
    return figure


# -- no solution -----------------------------------------------------------------------------------------------------

def no_solution(run: Path):
    a, b, _, y = matrix_of(run, "walls")
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.6, 3.5), width_ratios=(1, 1.15))
    bare(left, "a ball between two walls")
    for x0 in (-1.1, 0.6):
        body(left, [[x0, -0.75], [x0 + 0.5, -0.75], [x0 + 0.5, 0.75], [x0, 0.75]], FLOOR)
    ball(left, (0, 0), 0.6)
    arrow(left, (0.25, 0), (-0.35, 0), BLUE)
    note(left, (0, 0.18), "1 m/s", BLUE)
    note(left, (-0.85, -0.98), "wall 1: back at 1 m/s,\nw₁ = z₁ − z₂ − 2", fontsize=8.5)
    note(left, (0.85, -0.98), "wall 2: nothing comes nearer,\nw₂ = z₂ − z₁ + 1", fontsize=8.5)
    left.set(xlim=(-1.75, 1.75), ylim=(-1.3, 0.95))
    bare(right, "its cones leave out half of the plane")
    reach = 2.6
    cones_of(right, a, reach)
    along = np.array([1, -1]) / np.sqrt(2)
    right.plot(*np.array([-reach * along, reach * along]).T, color=RED, lw=1, ls=(0, (4, 3)))
    right.plot(*b, "o", ms=7, color=RED, zorder=6)
    note(right, b + [-0.1, -0.35], f"b = ({b[0]:g}, {b[1]:g})".replace("-", "−"), RED)
    arrow(right, (0, 0), 0.62 * reach * y / np.linalg.norm(y), GREEN, 2)
    note(right, 0.72 * reach * y / np.linalg.norm(y) + [0.25, 0.1], "$y$", GREEN, fontsize=11)
    note(right, (-0.95, -1.75), "here yᵀb < 0:\nno answer", RED)
    right.set(xlim=(-3.6, 3.4), ylim=(-3.0, 3.1))
    return figure


# -- four methods ---------------------------------------------------------------------------------------------------

def methods(run: Path):
    table = Table(run / "paths.csv")
    a, b, z, _ = matrix_of(run, "balls")
    method = np.array(table.text("method"))
    points = table.vectors("z1", "z2")
    figure, axes = plt.subplots(2, 2, figsize=(8.6, 6.6), sharex=True, sharey=True)
    x, y = np.meshgrid(np.linspace(-0.2, 4.2, 70), np.linspace(-0.2, 3.2, 70))
    hill = 0.5 * (a[0, 0] * x**2 + 2 * a[0, 1] * x * y + a[1, 1] * y**2) + b[0] * x + b[1] * y
    least = 0.5 * b @ z
    names = {"dantzig": ("Dantzig: a row at a time,\nthe others stay right", BLUE), "lemke": ("Lemke: along the edges\nof an easier problem", GREEN),
             "pgs": ("projected Gauss–Seidel:\nrow after row, again and again", ORANGE), "interior_point": ("interior point: through the middle,\nz w = μ in each row, μ to 0", RED)}
    for panel, (name, (title, colour)) in zip(axes.flat, names.items()):
        panel.contour(x, y, hill - least, levels=[0.02, 0.1, 0.3, 0.7, 1.4, 2.4, 4, 6], colors="#CFCFCF", linewidths=0.8)
        for i, style in ((0, (0, (5, 2))), (1, (0, (1.5, 2)))):
            line = np.array([-0.5, 5])
            panel.plot(line, -(b[i] + a[i, 0] * line) / a[i, 1], color=GREY, lw=1, ls=style)
        path = points[method == name]
        if name == "pgs":  # from sweep to sweep first z_1 changes, then z_2
            corners = [path[0]]
            for before, after in zip(path[:-1], path[1:]):
                corners += [(after[0], before[1]), after]
            panel.plot(*np.array(corners).T, color=colour)
            panel.plot(*path.T, "^", ms=6, color=colour)
        elif name == "interior_point":
            panel.plot(*path.T, color=colour)
            panel.plot(*path[::5].T, "D", ms=5, color=colour)
        else:
            panel.plot(*path.T, "o-", ms=6, color=colour)
        panel.plot(*z, "*", ms=13, color="black", zorder=6)
        panel.set_title(title, fontsize=9)
        panel.set(xlim=(-0.2, 4.2), ylim=(-0.2, 3.2), aspect="equal")
        panel.axhline(0, color=DARK, lw=0.7)
        panel.axvline(0, color=DARK, lw=0.7)
        panel.grid(False)
    axes[0, 0].text(3.0, 2.7, "w₁ = 0", color=GREY, fontsize=9)
    axes[0, 0].text(0.1, 1.3, "w₂ = 0", color=GREY, fontsize=9)
    for panel in axes[1]:
        panel.set_xlabel("z₁ [N s]")
    for panel in axes[:, 0]:
        panel.set_ylabel("z₂ [N s]")
    return figure


DRAWINGS = {f.__name__: f for f in (one_by_one, contact, matrix, cones, residual, drive, no_solution, methods)}


if __name__ == "__main__":
    draw(__doc__, DRAWINGS)
