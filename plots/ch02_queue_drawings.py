"""Chapter 2's drawings of the search: one look at a pair, which pairs are opened, the queue of a small search, and one time for each
pair against one for all. Drawn by ch02_drawings.py."""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from ch02_toy import COLOURS, PALES, Toy, look_at
from sketch import DARK, arrow, bare, body, length, note
from style import BLUE, GREEN, GREY, ORANGE, RED, Table

FATES = {"advanced": BLUE, "opened": ORANGE, "contact": RED}
TARGET = 0.01  # m, of ch02_pictures


class Looks:
    def __init__(self, run: Path):
        table = Table(run / "looks.csv")
        self.pair, self.fate = table.text("pair"), table.text("fate")
        self.time, self.gap, self.speed, self.next, self.radii = (table[name] for name in ("time", "gap", "speed", "next", "radii"))
        self.normal = table.vectors("nx", "ny")

    def __len__(self) -> int:
        return len(self.pair)


def supports(toy: Toy, pair: str, t: float, n: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The points of both hulls that are ahead along n."""
    a, b = (toy.hull(name, t) for name in pair.split("–"))
    return a[np.argmax(a @ n)], b[np.argmin(b @ n)]


def draw_slab(axes, toy: Toy, looks: Looks, k: int) -> None:
    """Two hulls, the plane between them, and their gap."""
    t, n = looks.time[k], looks.normal[k]
    across = np.array([-n[1], n[0]])
    p, q = supports(toy, looks.pair[k], t, n)
    for which, name in zip("AB", looks.pair[k].split("–")):
        body(axes, toy.hull(name, t), PALES[which] + "99", COLOURS[which], lw=1.8)
        note(axes, toy.hull(name, t).mean(axis=0), name, fontsize=11)
    for point in (p, q):
        axes.plot(*zip(point - 0.75 * across, point + 0.75 * across), color=GREY, lw=1)
    foot = p + n * np.dot(q - p, n)
    length(axes, p - 0.6 * across, foot - 0.6 * across, "g", 0.5 * (p + foot) - 0.6 * across + 0.13 * across, RED, fontsize=12)
    arrow(axes, p + 0.66 * across, p + 0.66 * across + 0.3 * n, DARK)
    note(axes, p + 0.66 * across + 0.36 * n, "n", DARK, fontsize=12)


def look(run: Path) -> plt.Figure:
    """The first look at a pair that is opened later on, and the true gap of that pair."""
    toy, looks, gaps = Toy(run), Looks(run), Table(run / "gaps.csv")
    k = next(i for i in range(len(looks)) if looks.fate[i] == "advanced" and looks.pair[i] != looks.pair[0])
    pair, t, g, s, until = looks.pair[k], looks.time[k], looks.gap[k], looks.speed[k], looks.next[k]
    figure, (scene, curve) = plt.subplots(1, 2, figsize=(9.2, 3.7), width_ratios=(1, 1.15))
    bare(scene, f"Look {k + 1}: the pair {pair} at {t:.2f} s")
    toy.draw(scene, t, face="none", lw=0.7, alpha=0.35)
    draw_slab(scene, toy, looks, k)
    look_at(scene, *(toy.hull(name, t) for name in pair.split("–")), margin=0.25)
    rows = np.array(gaps.text("pair")) == pair
    curve.plot(gaps["time"][rows], gaps["gap"][rows], color=GREY)
    end = g / s
    curve.plot([t, t + end], [g, 0], color=ORANGE, lw=1.2, ls="--")
    curve.plot([t, until], [g, TARGET], color=BLUE, lw=2.4)
    curve.axhline(TARGET, color=DARK, lw=1)
    curve.plot([t, until], [g, TARGET], "o", color=BLUE, ms=5)
    curve.plot([t, t], [0, g], color=RED, lw=1.2)
    note(curve, (t - 0.02, 0.5 * g), "g", RED, ha="right", fontsize=12)
    note(curve, (t + 0.04, 0.3 * g), "falls with s\nat the most", BLUE, ha="left")
    note(curve, (until + 0.01, 0.12 * g), "proved\nuntil here", BLUE, ha="left")
    note(curve, (0.17, float(np.interp(0.17, gaps["time"][rows], gaps["gap"][rows])) + 0.12 * g), "the true gap", GREY, ha="left")
    note(curve, (0.0, TARGET + 0.05 * g), "the target", DARK, ha="left")
    curve.set(title="Its gap [m]", xlim=(-0.01, 1), ylim=(0, None), xlabel="t [s]")
    return figure


def open_or_advance(run: Path) -> plt.Figure:
    toy, looks = Toy(run), Looks(run)
    shares = [(looks.gap[i] - TARGET) / looks.radii[i] for i in range(len(looks))]
    opened = max(i for i in range(len(looks)) if looks.fate[i] == "opened" and looks.pair[i] in looks.pair[:i])
    advanced = looks.pair.index(looks.pair[opened])
    figure, panels = plt.subplots(1, 2, figsize=(9.2, 3.5))
    for axes, k, title in ((panels[0], advanced, "much room: it waits again"), (panels[1], opened, "little room: the larger one is opened")):
        bare(axes, f"Look {k + 1}: {title}")
        t = looks.time[k]
        for which, name in zip("AB", looks.pair[k].split("–")):
            hull, node = toy.hull(name, t), toy.named(name)[1]
            centre = toy.placed(which, 0.5 * (node.points.min(axis=0) + node.points.max(axis=0))[None], t)[0]
            axes.add_patch(plt.Circle(centre, node.radius, fill=False, ec=COLOURS[which], lw=0.9, ls=":"))
            body(axes, hull, PALES[which], COLOURS[which], lw=1.6)
            reach = centre + node.radius * np.array([np.cos(1.1), np.sin(1.1)])
            arrow(axes, centre, reach, COLOURS[which], 1.0, "-|>", mutation_scale=8)
            note(axes, 0.5 * (centre + reach) + [0.12, -0.02], "$r_A$" if which == "A" else "$r_B$", COLOURS[which], fontsize=11)
            if k == opened and which == ("A" if toy.named(looks.pair[k].split("–")[0])[1].radius >= toy.named(looks.pair[k].split("–")[1])[1].radius else "B"):
                for child in (node.left, node.right):
                    body(axes, toy.hull(toy.nodes[which][child].name, t), "none", ORANGE, lw=1.6)
        p, q = supports(toy, looks.pair[k], t, looks.normal[k])
        foot = p + looks.normal[k] * np.dot(q - p, looks.normal[k])
        axes.plot(*zip(p, foot), color=RED, lw=2.6)
        note(axes, (0.5, -0.02), f"room = {shares[k]:.2f} $(r_A + r_B)$", RED, transform=axes.transAxes, fontsize=10)
        axes.autoscale_view()
    return figure


def queue(run: Path) -> plt.Figure:
    """Each pair has a lane; each look is a bar from its time to the time until which it proves the pair clear."""
    looks = Looks(run)
    lanes = list(dict.fromkeys(looks.pair))
    contact = looks.time[-1]
    figure, axes = plt.subplots(figsize=(9.2, 0.8 + 0.31 * len(lanes)))
    axes.axvline(contact, color=RED, lw=1, ls="--")
    for k in range(len(looks)):
        y, colour = -lanes.index(looks.pair[k]), FATES[looks.fate[k]]
        end = min(looks.next[k], 1.04)
        if looks.fate[k] != "contact":
            axes.plot([looks.time[k], end], [y, y], color=colour, lw=5, solid_capstyle="butt", alpha=0.45)
        axes.plot(looks.time[k], y, "*" if looks.fate[k] == "contact" else "o", color=colour, ms=13 if looks.fate[k] == "contact" else 4.5, zorder=3)
        crowded = [d for d in (-1, 1) if 0 <= k + d < len(looks) and looks.pair[k + d] == looks.pair[k] and abs(looks.time[k + d] - looks.time[k]) < 0.02]
        shift = -0.014 * crowded[0] if crowded else 0
        note(axes, (looks.time[k] + shift, y + 0.38), str(k + 1), DARK, fontsize=8.5)
    for fate, text in (("advanced", "looked at: waits again, proved clear for the bar"), ("opened", "looked at: opened; the children inherit the bar"),
                       ("contact", "the first contact")):
        axes.plot([], [], "*" if fate == "contact" else "o", color=FATES[fate], ms=11 if fate == "contact" else 5, label=text)
    axes.legend(loc="upper center", bbox_to_anchor=(0.47, -0.19), ncol=3, fontsize=9, columnspacing=1.2, handletextpad=0.3)
    axes.set(yticks=[-k for k in range(len(lanes))], yticklabels=lanes, xlim=(-0.015, 1.0), ylim=(-len(lanes) + 0.5, 0.75), xlabel="t [s]")
    return figure


def own_times(run: Path) -> plt.Figure:
    """The same small search with one step for all pairs, and with a time for each."""
    looks, rounds = Looks(run), Table(run / "rounds.csv")
    pairs, times = rounds.text("pair"), rounds["time"]
    lanes = list(dict.fromkeys([*looks.pair, *pairs]))
    figure, panels = plt.subplots(1, 2, figsize=(9.2, 0.9 + 0.25 * len(lanes)), sharey=True)
    steps = sorted(set(times))
    for t in steps:
        panels[0].axvline(t, color=GREY, lw=0.8)
    panels[0].plot(times, [-lanes.index(pair) for pair in pairs], "o", color=ORANGE, ms=5)
    panels[1].plot(looks.time, [-lanes.index(pair) for pair in looks.pair], "o", color=BLUE, ms=5)
    panels[0].set_title(f"One step for all: {len(steps)} steps, {len(pairs)} looks")
    panels[1].set_title(f"A time for each pair: {len(looks)} looks")
    for axes in panels:
        axes.axvline(looks.time[-1], color=RED, lw=1, ls="--")
        axes.set(xlim=(-0.02, 1.0), ylim=(-len(lanes) + 0.5, 0.6), yticks=[-k for k in range(len(lanes))], yticklabels=lanes, xlabel="t [s]")
        axes.grid(axis="x", visible=False)
    return figure


DRAWINGS = {"look": look, "open": open_or_advance, "queue": queue, "own_times": own_times}
