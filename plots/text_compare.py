"""Whether a text or a picture is still what was committed, up to the last digits of its numbers."""

import re

NUMBER = re.compile(r"(?<![\w#.])[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?", re.I)
TIMES = re.compile(r"(<!-- times: .*? -->).*?(<!-- /times -->)", re.S)  # never compared
# What matplotlib names by a digest of its numbers: a last digit changes the whole name.
DIGEST = re.compile(r'(?<=[#"])(p|m|h|C[0-9a-f]+_[0-9a-f]+_)[0-9a-f]{10}\b')
RELATIVE = 1e-9  # compilers round differently: numbers with many digits may differ there
PIXELS = 0.02  # the same in a picture


def allowed(number: str, picture: bool) -> float:
    """How far another number may be from this one: one unit of its last digit, or the relative tolerance."""
    mantissa, _, exponent = number.lower().partition("e")
    decimals = len(mantissa.partition(".")[2])
    digit = 10.0 ** (int(exponent or 0) - decimals) if decimals or exponent else 0  # whole numbers are counts: exact
    digits = len(mantissa.strip("+-0.").replace(".", ""))
    own = 1.001 * digit if digits < 8 else abs(float(number)) * RELATIVE
    return max(own, PIXELS) if picture and decimals else own


def named_in_order(picture: str) -> str:
    """The picture with its digests renamed in the order of their first appearance, so that references can still be compared."""
    names: dict[str, str] = {}
    return DIGEST.sub(lambda found: names.setdefault(found[0], f"name-{len(names)}"), picture)


def difference(committed: str, fresh: str, picture: bool = False) -> str:
    """`line: what differs`, the first difference only; empty if there is none. Differences of numbers within allowed() do not count."""
    committed, fresh = (TIMES.sub(r"\1\2", text) for text in (committed, fresh))
    if picture:
        committed, fresh = named_in_order(committed), named_in_order(fresh)
    if committed == fresh:
        return ""
    old_lines, new_lines = committed.splitlines(), fresh.splitlines()
    for number, (old, new) in enumerate(zip(old_lines, new_lines), start=1):
        if old == new:
            continue
        if NUMBER.sub("0", old) != NUMBER.sub("0", new):
            return f"{number}: has '{old.strip()[:160]}', but would be '{new.strip()[:160]}'"
        for a, b in zip(NUMBER.findall(old), NUMBER.findall(new)):
            if abs(float(a) - float(b)) > allowed(a, picture):
                return f"{number}: has the number {a}, but would have {b}"
    if len(old_lines) != len(new_lines):
        return f"{min(len(old_lines), len(new_lines)) + 1}: has {len(old_lines)} lines, but would have {len(new_lines)}"
    return ""
