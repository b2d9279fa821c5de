"""Chapter 2's drawings: convex pieces, trees of hulls, what one look at a pair proves, the queue, and which features touch.

Reads RUN_DIR, the tables of ch02_pictures. Writes one picture for each name into the folder --out.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from drawing_program import draw
import ch02_feature_drawings
import ch02_piece_drawings
import ch02_queue_drawings

DRAWINGS = {**ch02_piece_drawings.DRAWINGS, **ch02_queue_drawings.DRAWINGS, **ch02_feature_drawings.DRAWINGS}


if __name__ == "__main__":
    draw(__doc__, DRAWINGS)
