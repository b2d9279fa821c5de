#!/usr/bin/env python3
"""Draws a run of mesh bodies at four times, around its first two impacts: bunnies.py RUN_DIR

Needs poses.csv (the run's --poses), contacts.csv and the bodies' mesh. The renderer is a z-buffer in numpy, with no
perspective, so that lengths compare."""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from pathlib import Path

import matplotlib.patheffects as effects
import numpy as np

from style import BLUE, ORANGE, PlotError, Table, no_sweep, plot_main, plt

MESH = Path("/usr/share/glmark2/models/bunny.obj")  # Debian's package glmark2-data
WIDTH, HEIGHT, SAMPLES = 560, 290, 3  # of a panel in pixels; samples per pixel along each axis
LIGHTS = ((np.array([-0.5, -0.5, 0.75]), 0.75), (np.array([0.8, -0.5, 0.1]), 0.22))  # to the light; strength
AMBIENT = 0.22
ROUNDING = 1e-6  # of a pixel's weights: a pixel on an edge belongs to both sides, rather than to none
TITLE = 30  # pixels above each panel
LEVELS = 80  # of each colour: too fine to see, and a third less to store


def load_obj(file: Path) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (#V by 3, metres) and triangles (#F by 3) of a Wavefront OBJ."""
    if not file.exists():
        raise PlotError(f"{file}: no such mesh; install Debian's package glmark2-data")
    lines = file.read_text().splitlines()
    vertices = np.array([line.split()[1:4] for line in lines if line.startswith("v ")], float)
    corners = [line.split()[1:4] for line in lines if line.startswith("f ")]
    return vertices, np.array([[corner.split("/")[0] for corner in three] for three in corners], int) - 1


def center_of_mass(vertices: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """The centroid of the solid inside: a sum over the tetrahedra that the triangles form with the origin."""
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    volume = np.einsum("ij,ij->i", a, np.cross(b, c))
    return (volume[:, None] * (a + b + c)).sum(axis=0) / (4 * volume.sum())


def vertex_normals(vertices: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    face = np.cross(b - a, c - a)
    normals = np.stack([np.bincount(triangles.ravel(), np.repeat(face[:, k], 3), len(vertices)) for k in range(3)], 1)
    return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)


def rotation(q: np.ndarray) -> np.ndarray:
    w, x, y, z = q / np.linalg.norm(q)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def turned(spin: np.ndarray, time: float) -> np.ndarray:
    """The rotation by a constant spin (rad/s) for a time (s)."""
    angle = np.linalg.norm(spin) * time
    axis = spin / np.linalg.norm(spin) if angle else np.array([0, 0, 1.0])
    return rotation(np.concatenate([[np.cos(angle / 2)], np.sin(angle / 2) * axis]))


class Poses:
    """The bodies of a run at any time: from the end of the frame before, with the velocities there. Exact up to the
    first impact of a frame where there is no gravity."""

    def __init__(self, table: Table, center: np.ndarray):
        self.times = np.unique(table["t"])
        self.bodies = int(table["body"].max()) + 1
        columns = table.vectors("px", "py", "pz", "qw", "qx", "qy", "qz", "vx", "vy", "vz", "wx", "wy", "wz")
        order = np.lexsort((table["body"], table["t"]))
        if len(order) != len(self.times) * self.bodies:
            raise PlotError(f"{table.file}: not every body has a row in every frame")
        self.rows = columns[order].reshape(len(self.times), self.bodies, 13)
        self.center = center

    def at(self, time: float) -> list[tuple[np.ndarray, np.ndarray, np.ndarray]]:
        """For each body at a time: the position of its shape's frame, its rotation, its velocity."""
        frame = max(0, np.searchsorted(self.times, time, side="left") - 1) if time > self.times[0] else 0
        later = time - self.times[frame]
        result = []
        for row in self.rows[frame]:
            start = rotation(row[3:7])
            end = turned(row[10:13], later) @ start
            result.append((row[:3] + start @ self.center + later * row[7:10] - end @ self.center, end, row[7:10]))
        return result


def blurred(image: np.ndarray, radius: int) -> np.ndarray:
    """Three box blurs along each axis: nearly a Gaussian."""
    n = 2 * radius + 1
    for axis in (0, 1) * 3:
        padded = np.pad(image, [(radius + 1, radius) if k == axis else (0, 0) for k in (0, 1)], mode="edge")
        total = np.cumsum(padded, axis=axis)
        image = (total[n:] - total[:-n] if axis == 0 else total[:, n:] - total[:, :-n]) / n
    return image


def rasterize(corners: np.ndarray, colors: np.ndarray, width: int, height: int) -> tuple[np.ndarray, np.ndarray]:
    """Colours (height by width by 3) and depths of the nearest of many small triangles, given by their corners
    (#F by 3 by (x, y, depth); pixels, larger is nearer) and their colours (#F by 3)."""
    x, y, depth = (corners[:, :, k] for k in range(3))
    area = (x[:, 1] - x[:, 0]) * (y[:, 2] - y[:, 0]) - (y[:, 1] - y[:, 0]) * (x[:, 2] - x[:, 0])
    keep = area > 1e-12  # those that face the viewer
    x, y, depth, area, colors = x[keep], y[keep], depth[keep], area[keep][:, None], colors[keep]
    low_x, low_y = np.ceil(x.min(axis=1)).astype(int), np.ceil(y.min(axis=1)).astype(int)
    wide, high = np.floor(x.max(axis=1)).astype(int) - low_x + 1, np.floor(y.max(axis=1)).astype(int) - low_y + 1
    # The weight of corner k at the pixel (low_x + dx, low_y + dy) is across_k dx + along_k dy + rest_k.
    x, y = x - low_x[:, None], y - low_y[:, None]
    next_x, next_y, last_x, last_y = (np.roll(array, shift, axis=1) for shift in (-1, -2) for array in (x, y))
    across, along, rest = (next_y - last_y) / area, (last_x - next_x) / area, (next_x * last_y - last_x * next_y) / area
    across, along, rest = (array.T.astype(np.float32) for array in (across, along, rest))  # fewer digits suffice
    pixels, depths, triangles = [], [], []
    # Visit one pixel of every triangle's bounding box at once, then the next one: few rounds, for triangles are small.
    for dy in range(high.max(initial=0)):
        tall = np.flatnonzero(high > dy)
        for dx in range(wide[tall].max(initial=0)):
            some = tall[wide[tall] > dx]
            weights = np.stack([across[k, some] * dx + along[k, some] * dy + rest[k, some] for k in range(3)])
            inside = (weights[0] >= -ROUNDING) & (weights[1] >= -ROUNDING) & (weights[2] >= -ROUNDING)
            some, weights = some[inside], weights[:, inside]
            px, py = low_x[some] + dx, low_y[some] + dy
            seen = (px >= 0) & (py >= 0) & (px < width) & (py < height)
            pixels.append((py * width + px)[seen])
            depths.append(np.einsum("ki,ik->i", weights, depth[some])[seen])
            triangles.append(some[seen])
    pixel, near, triangle = (np.concatenate(parts) if parts else np.zeros(0, int) for parts in (pixels, depths, triangles))
    order = np.lexsort((near, pixel))  # by pixel, the nearest last
    order = order[np.append(np.diff(pixel[order]) > 0, True)] if len(order) else order
    image, nearest = np.ones((height * width, 3)), np.full(height * width, -np.inf)
    image[pixel[order]], nearest[pixel[order]] = colors[triangle[order]], near[order]
    return image.reshape(height, width, 3), nearest.reshape(height, width)


def shade(normals: np.ndarray, color: str) -> np.ndarray:
    base = np.array([int(color[k:k + 2], 16) / 255 for k in (1, 3, 5)])
    light = np.full(len(normals), AMBIENT)
    for direction, strength in LIGHTS:
        light += strength * np.clip((normals @ direction / np.linalg.norm(direction) + 0.25) / 1.25, 0, 1)
    return np.clip(light[:, None] * base + 0.12 * np.clip(light - 0.7, 0, 1)[:, None], 0, 1)


def render(bodies: list, camera: np.ndarray, middle: np.ndarray, scale: float) -> np.ndarray:
    """A picture of bodies (vertices, normals, triangles, colour); camera: rows right, up, towards the viewer."""
    width, height = SAMPLES * WIDTH, SAMPLES * HEIGHT
    corners, colors = [], []
    for vertices, normals, triangles, color in bodies:
        pixels = ((vertices - middle) @ camera.T) * scale * SAMPLES + (width / 2, height / 2, 0)
        corners.append(pixels[triangles])
        colors.append(shade(normals, color)[triangles].mean(axis=1))  # they are smaller than a pixel of the picture
    image, depth = rasterize(np.concatenate(corners), np.concatenate(colors), width, height)
    # Where the surroundings are nearer, less light comes in: darken creases by the blurred depth (Luft et al. 2006).
    hit = np.isfinite(depth)
    summed, hits = (blurred(array.reshape(HEIGHT, SAMPLES, WIDTH, SAMPLES).mean(axis=(1, 3)), WIDTH // 90)
                    for array in (np.where(hit, depth, 0), hit.astype(float)))
    around = (summed / np.maximum(hits, 1e-9)).repeat(SAMPLES, axis=0).repeat(SAMPLES, axis=1)
    image[hit] *= (1 - np.clip((around - np.where(hit, depth, 0))[hit] / (0.12 * height), 0, 0.6))[:, None]
    return image.reshape(HEIGHT, SAMPLES, WIDTH, SAMPLES, 3).mean(axis=(1, 3))


def instants(contacts: Table, poses: Poses) -> list[tuple[float, str, np.ndarray]]:
    """The four times to draw: what they are, and the contact points then."""
    points, times = contacts.vectors("x", "y", "z"), contacts["t"]
    first, last, none = poses.times[0], poses.times[-1], np.zeros((0, 3))
    frame = np.searchsorted(poses.times, times)
    impacts = [times[frame == k].min() for k in np.unique(frame)][:2]  # the first two frames with an impact
    if len(impacts) == 0:
        return [(t, "", none) for t in np.linspace(first, last, 4)]
    between = (impacts[0] + (impacts[1] if len(impacts) > 1 else last)) / 2
    at = [points[times == impact] for impact in impacts]
    return [(first, "the start", none), (impacts[0], "first impact", at[0]), (between, "apart", none),
            (impacts[1], "second impact", at[1]) if len(impacts) > 1 else (last, "the end", none)]


def draw(run: Path, mesh: Path, scale: float) -> plt.Figure:
    no_sweep(run)
    vertices, triangles = load_obj(mesh)
    vertices *= scale
    normals = vertex_normals(vertices, triangles)
    poses = Poses(Table(run / "poses.csv"), center_of_mass(vertices, triangles))
    panels = instants(Table(run / "contacts.csv"), poses)

    # Look from the side, a little from above, at the line between the first two bodies.
    across = poses.at(panels[0][0])[1][0] - poses.at(panels[0][0])[0][0] if poses.bodies > 1 else np.array([1.0, 0, 0])
    right = np.array([across[0], across[1], 0]) / (np.hypot(across[0], across[1]) or 1)
    back = np.array([right[1], -right[0], 0])
    toward = np.cos(0.3) * back + np.sin(0.3) * np.array([0, 0, 1])
    camera = np.stack([right, np.cross(toward, right), toward])

    placed = [[(p + vertices @ r.T, normals @ r.T) for p, r, _ in poses.at(time)] for time, _, _ in panels]
    seen = np.concatenate([v for panel in placed for v, _ in panel]) @ camera.T
    middle = camera.T @ ((seen.min(axis=0) + seen.max(axis=0)) / 2)
    zoom = min(0.94 * np.array([WIDTH, HEIGHT]) / np.ptp(seen, axis=0)[:2])

    def on_panel(points: np.ndarray) -> np.ndarray:
        return ((points - middle) @ camera.T * zoom)[..., :2] + (WIDTH / 2, HEIGHT / 2)

    size, dpi = np.array([2 * WIDTH, 2 * (HEIGHT + TITLE)]), plt.rcParams["savefig.dpi"]
    figure = plt.figure(figsize=size / dpi)
    figure.set_layout_engine("none")  # the panels stand at exact pixels
    fastest = max(np.linalg.norm(v) for time, _, _ in panels for _, _, v in poses.at(time)) or 1
    for k, (bodies, (time, title, points)) in enumerate(zip(placed, panels)):
        corner = np.array([k % 2 * WIDTH, (1 - k // 2) * (HEIGHT + TITLE)])
        panel = figure.add_axes((*(corner / size), *(np.array([WIDTH, HEIGHT]) / size)))  # a pixel is a pixel
        colored = [(v, n, triangles, (ORANGE, BLUE)[body % 2]) for body, (v, n) in enumerate(bodies)]
        image = np.round(render(colored, camera, middle, zoom) * LEVELS) / LEVELS
        panel.imshow(image, origin="lower", interpolation="none", extent=(0, WIDTH, 0, HEIGHT))
        panel.plot(*on_panel(points).T, "o", color="#CC0000", markersize=7, markeredgecolor="white")
        for position, turn, velocity in poses.at(time) if not len(points) else []:
            start = position + turn @ poses.center
            tip = on_panel(start + 0.6 * np.ptp(vertices, axis=0).max() * velocity / fastest)
            if np.linalg.norm(tip - on_panel(start)) > 12:
                arrow = panel.annotate("", tip, on_panel(start), arrowprops={
                    "arrowstyle": "-|>", "color": "#222222", "linewidth": 2, "mutation_scale": 16, "shrinkA": 0})
                arrow.arrow_patch.set_path_effects([effects.withStroke(linewidth=5, foreground="white")])
        count = f", {len(points)} contact{'s' * (len(points) > 1)}" if len(points) else ""
        panel.text(10, HEIGHT + 6, f"t = {time:.3f} s", weight="bold")
        panel.text(122, HEIGHT + 6, title + count)
        panel.set(xlim=(0, WIDTH), ylim=(0, HEIGHT))
        panel.axis("off")
    return figure


if __name__ == "__main__":
    plot_main(draw, "bunnies", __doc__,
              mesh={"type": Path, "default": MESH, "help": "the bodies' OBJ; default: %(default)s"},
              scale={"type": float, "default": 1.0, "help": "of the mesh; default: 1"})
