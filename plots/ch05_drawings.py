"""Chapter 5's drawings. Those that show bodies in contact are drawn from runs, the others from the formulas of the text.

Reads RUN_DIR/knocked, bounces, ball, islands, frame, turned, touching, slope and stack: runs of chapter 5's scenes, as its text makes
them. Writes one picture for each name into the folder --out.
"""

import drawing_python  # noqa: F401  first: it finds a Python that can draw

from drawing_program import draw
import ch05_plan_drawings
import ch05_run_drawings

DRAWINGS = {**ch05_run_drawings.DRAWINGS, **ch05_plan_drawings.DRAWINGS}


if __name__ == "__main__":
    draw(__doc__, DRAWINGS)
