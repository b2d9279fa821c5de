"""What can be wrong with the texts without running anything: links, figures, anchors, mathematics."""

import re
from pathlib import Path

from text_marks import ANCHOR

LINK = re.compile(r"(!?)\[(?:[^\[\]]|\[[^\]]*\])*\]\(([^)\s]+)\)")
CODE = re.compile(r"^```.*?^```$|^(?: {4}|\t)[^\n]*$|`[^`\n]+`", re.M | re.S)
INLINE_MATH = re.compile(r"(?<![\\$`\w])\$(?!\$|`)([^$\n]+)\$(?![\w$])")
SNIPPET = re.compile(r"<!-- snippet: (\S+)#(\w+) -->")


def figures(root: Path) -> list[Path]:
    return sorted([*root.glob("chapters/**/*.svg"), *root.glob("chapters/**/*.png"), *root.glob("plots/figures/*")])


def heading_id(heading: str) -> str:
    """The anchor that GitHub makes of a heading."""
    plain = re.sub(r"[`*]|\[([^\]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
    return re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")


def blanked(match: re.Match) -> str:
    return re.sub(r"[^\n]", " ", match[0])


def link_faults(page: Path, root: Path, shown: set[Path]) -> list[str]:
    text = CODE.sub(blanked, page.read_text(encoding="utf-8"))
    faults = []
    for match in LINK.finditer(text):
        where = f"{page.relative_to(root)}:{text.count(chr(10), 0, match.start()) + 1}"
        image, target = match.groups()
        if re.match(r"\w+://", target):
            continue
        name, _, heading = target.partition("#")
        file = (page.parent / name).resolve() if name else page.resolve()
        if not file.exists():
            faults.append(f"{where}: {'no figure' if image else 'a link to nothing:'} {target}")
            continue
        if image:
            shown.add(file)
        if heading:
            page_there = file / "README.md" if file.is_dir() else file
            ids = {heading_id(line.lstrip("#")) for line in page_there.read_text(encoding="utf-8").splitlines() if line.startswith("#")}
            if heading not in ids:
                faults.append(f"{where}: a link to a heading that is not there: {target}")
    return faults


def math_faults(page: Path, root: Path) -> list[str]:
    """GitHub reads Markdown before mathematics: what Markdown would consume must be in a ```math block or in $`...`$."""
    whole = page.read_text(encoding="utf-8")
    text = CODE.sub(blanked, re.sub(r"\$`[^`\n]*`\$", blanked, whole))
    faults = []

    def tell(at: int, what: str) -> None:
        faults.append(f"{page.relative_to(root)}:{text.count(chr(10), 0, at) + 1}: {what}")

    for match in re.finditer(r"\$\$", text):
        tell(match.start(), "mathematics in $$: use a ```math block")
    rest = list(text)
    for match in INLINE_MATH.finditer(text):
        body = match[1]
        rest[match.start():match.end()] = " " * len(match[0])
        if body != body.strip():
            tell(match.start(), f"a blank inside the dollars: ${body}$")
        if re.search(r"\\[^A-Za-z\s]", body):
            tell(match.start(), f"Markdown eats the backslash in ${body}$: write $`{body}`$")
        if re.search(r"\*|<[A-Za-z/!?]", body):
            tell(match.start(), f"Markdown reads * and tags in ${body}$: write \\ast, \\lt")
        line = text[text.rfind("\n", 0, match.start()) + 1:text.find("\n", match.end())]
        if "|" in body and line.startswith("|"):
            tell(match.start(), f"the bar in ${body}$ ends the table's cell: write \\lvert, \\mid")
    for match in re.finditer(r"(?<!\\)\$", "".join(rest)):
        tell(match.start(), "a dollar without its other one, or one that touches a word")
    return faults


def anchor_faults(root: Path, pages: list[Path]) -> list[str]:
    used = {(file, anchor) for page in pages for file, anchor in SNIPPET.findall(page.read_text(encoding="utf-8"))}
    faults = []
    for source in sorted([*root.glob("common/*.[hc]pp"), *root.glob("chapters/**/*.[hc]pp"), *root.glob("exercises/**/*.[hc]pp")]):
        for number, line in enumerate(source.read_text(encoding="utf-8").splitlines(), start=1):
            match = ANCHOR.match(line)
            if match and (str(source.relative_to(root)), match[2]) not in used:
                faults.append(f"{source.relative_to(root)}:{number}: no text shows this anchor: {match[2]}")
    return faults


def faults(root: Path, pages: list[Path]) -> list[str]:
    shown: set[Path] = set()
    found = [fault for page in pages for fault in link_faults(page, root, shown) + math_faults(page, root)]
    found += [f"{figure.relative_to(root)}: no text shows this figure" for figure in figures(root) if figure.resolve() not in shown]
    return found + anchor_faults(root, pages)
