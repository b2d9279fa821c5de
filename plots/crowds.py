"""Summaries of more points than a picture can show."""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from typing import NamedTuple

import numpy as np

from style import plt

MOST_POINTS = 2000  # drawn one by one; for more, bands show where most of them are
MOST_BINS = 600  # along an axis: a picture of this size has no pixels for more


class Bins(NamedTuple):
    """Intervals along an axis, of at most MOST_BINS."""

    edges: np.ndarray
    stride: int  # of the points given, this many make a bin

    @classmethod
    def between(cls, points: np.ndarray) -> "Bins":
        """One bin from each of the ascending points to the next, or to the second, third, … next."""
        stride = max(1, int(np.ceil((len(points) - 1) / MOST_BINS)))
        inner = points[:-1:stride] if len(points) > 1 else points
        last = points[-1] if len(points) > 1 else points[0] + 1
        return cls(np.append(inner, last), stride)

    @property
    def ends(self) -> np.ndarray:
        return self.edges[1:]

    def reduced(self, values: np.ndarray, how: np.ufunc) -> np.ndarray:
        """One value for each bin, of those at the points behind its first edge: np.maximum.reduced their largest."""
        rows = values[1:] if len(values) > 1 else values
        return how.reduceat(rows, np.arange(0, len(rows), self.stride))

    def of(self, x: np.ndarray) -> np.ndarray:
        """The bin of each x; one that lies on an edge belongs to the bin that begins there."""
        return np.clip(np.searchsorted(self.edges, x, side="right") - 1, 0, len(self.edges) - 2)


def quantiles(bins: Bins, x: np.ndarray, values: np.ndarray, shares: tuple[float, ...]) -> list[np.ndarray]:
    """For each share, in each bin the value below which that share of the bin's values lie; NaN where there are none."""
    bin_of = bins.of(x)
    order = np.lexsort((values, bin_of))
    first = np.searchsorted(bin_of[order], np.arange(len(bins.edges)))
    count = np.diff(first)
    found = []
    for share in shares:
        index = np.minimum(first[:-1] + np.round(share * (count - 1)).astype(int), len(values) - 1)
        found.append(np.where(count > 0, values[order][index], np.nan))
    return found


def draw_bands(axes: plt.Axes, bins: Bins, x: np.ndarray, values: np.ndarray, color: str, name: str, farthest: str = "largest") -> None:
    """For each bin the median, the range of 90 % of the values, and the largest (or the smallest)."""
    low, middle, high, end = quantiles(bins, x, values, (0.05, 0.5, 0.95, 1.0 if farthest == "largest" else 0.0))
    axes.stairs(high, bins.edges, baseline=low, fill=True, color=color, alpha=0.3, linewidth=0, label=f"{name}, 5–95 %")
    axes.stairs(middle, bins.edges, baseline=None, color=color, linewidth=1.2, label="median")
    axes.stairs(end, bins.edges, baseline=None, color=color, linewidth=0.6, linestyle=":", label=farthest)


def thinned(x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A curve that looks the same with fewer points: of every group of points the lowest and the highest stay."""
    stride = int(np.ceil(len(x) / MOST_POINTS))
    if stride <= 1:
        return x, y
    starts = np.arange(0, len(x), stride)
    keep = {0, len(x) - 1}
    for start in starts:
        part = y[start:start + stride]
        keep |= {start + int(np.argmin(part)), start + int(np.argmax(part))}
    index = np.array(sorted(keep))
    return x[index], y[index]
