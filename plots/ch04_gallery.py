#!/usr/bin/env python3
"""The gallery of chapter 4: one picture and one curve of each scene.

Reads DIR/<scene>/motion.glb and steps.csv of every run in DIR. A picture is drawn back to front: triangles far away
first (a painter's algorithm), without perspective; of fine meshes a coarser one, made by merging vertices."""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

import json
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.ticker import FuncFormatter, MaxNLocator

from style import BLUE, GREEN, GREY, ORANGE, PURPLE, RED, SKY, PlotError, Table, plot_main

# Scene, what it shows, and the time of the picture in s.
SCENES = [("two_bunnies", "two bunnies", 0.48), ("hundred_bunnies", "a hundred bunnies", 0.9), ("gas", "a gas of four shapes", 0.6),
          ("break", "a break shot", 0.12), ("bolt", "a bolt in its nut", 1.5), ("gears", "gears, one driven", 1.0),
          ("bullets", "bullets, a thin wall", 0.05), ("tops", "tops in space", 2.6), ("dominoes", "a chain reaction", 3.0),
          ("paddle", "a paddle heats a gas", 0.9), ("rain", "rain, past a barrier", 1.2), ("sleepers", "sleepers, woken", 2.1),
          ("rings", "a chain of rings", 2.5), ("pi", "314 impacts count π", 6.0), ("cradle", "a cradle", 0.6),
          ("bounce", "towards Zeno", 1.6), ("tumbling_boxes", "things in a tray", 0.9)]
COLOURS = [BLUE, ORANGE, GREEN, PURPLE, SKY, RED]
FINE, COARSE = 3000, 18  # triangles above which a mesh is merged, cells along its longest side then
SIDE = 4.0  # m: a static shape larger than this is a wall or a floor
TYPES = {5126: np.float32, 5123: np.uint16, 5125: np.uint32, 5121: np.uint8}
LANES = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}
LIGHT = np.array([-0.4, -0.55, 0.73])


class Motion:
    """The bodies of a motion.glb at any time."""

    def __init__(self, file: Path):
        try:
            data = file.read_bytes()
        except OSError:
            raise PlotError(f"{file}: no such file; run the scene first") from None
        length = int.from_bytes(data[12:16], "little")
        self.json, self.bytes = json.loads(data[20:20 + length]), data[28 + length:]
        self.shapes = {}
        self.keys: dict = {}
        for animation in self.json.get("animations", []):
            for channel in animation["channels"]:
                sampler = animation["samplers"][channel["sampler"]]
                self.keys[channel["target"]["node"], channel["target"]["path"]] = (sampler["input"], sampler["output"])

    def array(self, accessor: int) -> np.ndarray:
        a = self.json["accessors"][accessor]
        view = self.json["bufferViews"][a["bufferView"]]
        lanes = LANES[a["type"]]
        flat = np.frombuffer(self.bytes, TYPES[a["componentType"]], a["count"] * lanes, view["byteOffset"] + a.get("byteOffset", 0))
        return flat.reshape(-1, lanes) if lanes > 1 else flat

    def shape(self, mesh: int) -> tuple[np.ndarray, np.ndarray]:
        if mesh not in self.shapes:
            part = self.json["meshes"][mesh]["primitives"][0]
            vertices, triangles = self.array(part["attributes"]["POSITION"]).astype(float), self.array(part["indices"]).reshape(-1, 3).astype(int)
            self.shapes[mesh] = merged(vertices, triangles) if len(triangles) > FINE else (vertices, triangles)
        return self.shapes[mesh]

    def value(self, node: int, path: str, time: float) -> np.ndarray:
        if (node, path) not in self.keys:
            return np.array(self.json["nodes"][node][path])
        times, values = (self.array(a) for a in self.keys[node, path])
        k = min(np.searchsorted(times, time), len(times) - 1)
        if k == 0 or times[k] == times[k - 1]:
            return values[k]
        part = np.clip((time - times[k - 1]) / (times[k] - times[k - 1]), 0, 1)
        return (1 - part) * values[k - 1] + part * values[k] * (1 if path == "translation" or values[k - 1] @ values[k] >= 0 else -1)

    def bodies(self, time: float) -> list:
        """Of each body: world triangles (#F by 3 by 3), whether it is static, its mesh."""
        result = []
        for index, node in enumerate(self.json["nodes"]):
            if not node["name"].startswith("body_"):
                continue
            vertices, triangles = self.shape(node["mesh"])
            x, y, z, w = self.value(index, "rotation", time) / np.linalg.norm(self.value(index, "rotation", time))
            turn = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                             [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                             [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])
            result.append(((vertices @ turn.T + self.value(index, "translation", time))[triangles],
                           node.get("extras", {}).get("static", False), node["mesh"]))
        return result


def merged(vertices: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The mesh with all vertices of a cell of a grid in one place."""
    cell = np.ptp(vertices, axis=0).max() / COARSE
    _, place, count = np.unique(np.floor(vertices / cell).astype(int), axis=0, return_inverse=True, return_counts=True)
    place = place.ravel()
    middle = np.stack([np.bincount(place, vertices[:, k]) for k in range(3)], axis=1) / count[:, None]
    kept = place[triangles]
    kept = kept[(kept[:, 0] != kept[:, 1]) & (kept[:, 1] != kept[:, 2]) & (kept[:, 2] != kept[:, 0])]
    return middle, kept


def picture(axes: plt.Axes, motion: Motion, time: float) -> None:
    toward = np.array([0.35, -0.83, 0.43])
    toward /= np.linalg.norm(toward)
    right = np.cross([0, 0, 1], toward)
    right /= np.linalg.norm(right)
    camera = np.stack([right, np.cross(toward, right), toward])
    polygons, colours, depths, free = [], [], [], []
    for number, (corners, still, mesh) in enumerate(motion.bodies(time)):
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
        wall = still and np.ptp(corners.reshape(-1, 3), axis=0).max() > SIDE
        facing = normal @ toward > 0
        keep = facing if not wall else facing & (normal @ (corners.reshape(-1, 3).mean(axis=0)) < 0.1)  # only walls behind
        if not wall:
            free.append(corners.reshape(-1, 3).mean(axis=0))
        base = np.array([int((GREY if still else COLOURS[(mesh if motion.json["meshes"] and len(motion.shapes) > 2 else number) % len(COLOURS)])[k:k + 2], 16)
                         / 255 for k in (1, 3, 5)])
        light = np.clip(0.55 + 0.45 * (normal[keep] @ LIGHT), 0.25, 1)[:, None]
        seen = corners[keep] @ camera.T
        polygons.append(seen[..., :2])
        depths.append(seen[..., 2].mean(axis=1) - (1e6 if wall else 0))
        colours.append(np.clip(light * base, 0, 1) if not wall else np.clip(0.72 + 0.2 * light * np.ones(3), 0, 1))
    polygons, colours, depths = np.concatenate(polygons), np.concatenate(colours), np.concatenate(depths)
    order = np.argsort(depths)
    axes.add_collection(PolyCollection(polygons[order], facecolors=colours[order], edgecolors=colours[order], linewidths=0.15, rasterized=True))
    spots = polygons[depths > -1e5].reshape(-1, 2)
    low, high = np.percentile(spots, 0.5, axis=0), np.percentile(spots, 99.5, axis=0)
    middle, size = (low + high) / 2, 0.58 * max((high - low)[0] / 1.45, (high - low)[1])
    axes.set_xlim(middle[0] - 1.45 * size, middle[0] + 1.45 * size)
    axes.set_ylim(middle[1] - size, middle[1] + size)
    axes.set_aspect("equal")
    axes.set_axis_off()


def plain(value: float, _: int = 0) -> str:
    """20k for 20,000: short enough for a small axis, and no power of ten beside it."""
    for unit, name in ((1e6, "M"), (1e3, "k")):
        if abs(value) >= unit:
            return f"{value / unit:g}{name}"
    return f"{value:g}"


def curve(axes: plt.Axes, t: np.ndarray, impacts: np.ndarray, energy: np.ndarray, time: float) -> None:
    right = axes.twinx()
    for panel, values, colour in ((axes, np.cumsum(impacts), BLUE), (right, energy, RED)):
        panel.plot(t, values, color=colour, lw=1.4)
        panel.tick_params(axis="y", labelsize=8.5, colors=colour, pad=1)
        panel.yaxis.set_major_locator(MaxNLocator(3, integer=panel is axes))
        panel.yaxis.set_major_formatter(FuncFormatter(plain))
        panel.grid(False)
    axes.axvline(time, color=GREY, lw=0.8, ls=":")
    axes.tick_params(axis="x", labelsize=8.5, pad=1)
    axes.xaxis.set_major_locator(MaxNLocator(5))
    right.spines["right"].set_visible(False)
    low, high = energy.min(), energy.max()
    if high - low < 1e-6 * max(abs(high), abs(low)):
        right.set_ylim(low - 0.5 * abs(low), low + 0.5 * abs(low) + 1e-9)


def draw(runs: Path) -> plt.Figure:
    there = [s for s in SCENES if (runs / s[0] / "motion.glb").exists()]
    if not there:
        raise PlotError(f"{runs}: no runs of the gallery's scenes; run them with --out {runs}/<scene>")
    columns, rows = 3, -(-(len(there) + 1) // 3)
    figure = plt.figure(figsize=(11, 3.5 * rows))
    figure.set_layout_engine("none")

    def cell(k: int) -> tuple[float, float]:
        return (k % columns) / columns, 1 - (k // columns + 1) / rows

    def below(k: int) -> plt.Axes:
        return figure.add_axes((cell(k)[0] + 0.13 / columns, cell(k)[1] + 0.12 / rows, 0.72 / columns, 0.21 / rows))

    for k, (scene, title, time) in enumerate(there):
        x, y = cell(k)
        axes = figure.add_axes((x + 0.02 / columns, y + 0.36 / rows, 0.96 / columns, 0.54 / rows))
        picture(axes, Motion(runs / scene / "motion.glb"), time)
        figure.text(x + 0.01, y + 0.93 / rows, title, fontsize=11, weight="bold")
        steps = Table(runs / scene / "steps.csv")
        curve(below(k), steps["t"], steps["impacts"], steps["energy"], time)
    key, (x, y) = below(len(there)), cell(len(there))
    t = np.linspace(0, 1, 60)
    curve(key, t, (np.arange(60) % 12 == 11).astype(float), 3 - np.floor(5 * t) / 5, 0.5)
    key.set(xlabel="time [s]")
    for text, colour, place in (("impacts so far", BLUE, 0.52), ("total energy [J]", RED, 0.44),
                                ("dotted: when the picture was taken", GREY, 0.36)):
        figure.text(x + 0.13 / columns, y + place / rows, text, fontsize=9.5, color=colour)
    return figure


if __name__ == "__main__":
    plot_main(draw, "ch04_gallery", __doc__)
