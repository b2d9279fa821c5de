"""Finds a Python that can draw. Every plot script imports this first, so that `python3 plots/energy.py DIR` also works
where `python3` is one without matplotlib (a virtual environment, pyenv, conda): the distribution's Python takes over."""

import os
import sys

DISTRIBUTION = "/usr/bin/python3"
ASKED = "FIRST_CONTACT_PYTHON_ASKED"  # in the environment of a Python that took over: which ones could not draw, and why


def lacking():
    """What this Python lacks; empty if it can draw. Written so that any Python 3 can run it."""
    if sys.version_info < (3, 10):
        return "older than 3.10"
    try:
        import matplotlib
        matplotlib.use("Agg")
        import matplotlib.pyplot  # noqa: F401
        import numpy  # noqa: F401
    except Exception as error:  # missing, or made for another numpy: that fails in many ways
        return str(error).strip().partition("\n")[0] or type(error).__name__
    release = tuple(int(part) for part in matplotlib.__version__.split(".")[:2])
    return "" if release >= (3, 6) else "matplotlib " + matplotlib.__version__ + ", older than 3.6"


def find():
    why = lacking()
    if not why:
        return
    script = os.path.abspath(sys.argv[0])
    tried = "%s (%s)" % (sys.executable, why)
    if ASKED not in os.environ and os.path.isfile(script):
        try:  # without the paths that the other Python's environment sets (-E), and a user's own packages (-s)
            os.execve(DISTRIBUTION, [DISTRIBUTION, "-E", "-s", script] + sys.argv[1:], dict(os.environ, **{ASKED: tried}))
        except OSError:
            pass  # there is none
    everybody = ", ".join(filter(None, [os.environ.get(ASKED), tried]))
    sys.stderr.write("%s: no Python here can draw: %s. Install Debian's package python3-matplotlib, or matplotlib 3.6 or "
                     "later into the python3 of your own\n" % (os.path.basename(script), everybody))
    sys.exit(2)


find()
