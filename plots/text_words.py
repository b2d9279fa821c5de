"""What a chapter's text must have to be readable in an evening: a core path of at most MOST_WORDS words, a table of all
symbols in its formulas, and the glossary's words."""

import re
from pathlib import Path

MOST_WORDS = 2500  # of a chapter's README.md; second readings are in MORE.md
COMMENT = re.compile(r"<!--.*?-->", re.S)
FENCED = re.compile(r"^```.*?^```$|^(?: {4}|\t)[^\n]*$", re.M | re.S)
FOLDED = re.compile(r"<details>.*?</details>", re.S)
INLINE = re.compile(r"(?<![\\$\w])\$`([^`\n]+)`\$|(?<![\\$`\w])\$(?!\$|`)([^$\n]+)\$(?![\w$])")
BLOCK = re.compile(r"^```math\n(.*?)^```$", re.M | re.S)
ROW = re.compile(r"^\|([^\n]*)\|\s*$", re.M)
# LaTeX commands that are not symbols: operators, relations, functions, fonts, spaces, brackets.
NO_SYMBOLS = set("""cdot times le ge leq geq ne neq lt gt approx equiv sim in notin subset cup cap to mapsto rightarrow leftarrow Rightarrow Leftrightarrow
iff implies quad qquad frac tfrac dfrac sqrt sum prod int min max sup inf arg sin cos tan arctan arcsin arccos sinh cosh tanh log ln exp det dim rank tr
left right big Big bigl bigr Bigl Bigr lvert rvert lVert rVert mid vert Vert langle rangle lfloor rfloor lceil rceil begin end pmatrix bmatrix matrix cases
array aligned ldots cdots vdots ddots dots hat bar dot ddot tilde vec overline underline underbrace overbrace mathbf boldsymbol mathcal mathbb mathsf top
bot perp parallel pm mp infty partial nabla circ ast star prime forall exists land lor neg colon displaystyle textstyle hline limits nolimits bmod ll gg
propto setminus emptyset widehat widetilde mathop operatorname mathrm text mathit tag not oplus otimes wedge vee cong succeq preceq succ prec sphericalangle
angle deg stackrel overset underset phantom hspace vspace smallmatrix substack label Longrightarrow longrightarrow ni hookrightarrow""".split())
INDICES = {"i", "j", "k", "O"}  # counters, and the order of a cost: they need no explanation
WORDS_INSIDE = re.compile(r"\\(?:text|textrm|textit|mathrm|operatorname|tag|begin|end|label|mathop)\*?\s*\{[^{}]*\}")


def blank(match: re.Match) -> str:
    return re.sub(r"[^\n]", " ", match[0])


def core_words(text: str) -> int:
    """Number of words of the prose alone: no code, formulas, tables, pictures, comments, folded blocks."""
    for pattern in (FOLDED, COMMENT, FENCED, INLINE):
        text = pattern.sub(" ", text)
    text = re.sub(r"^\|[^\n]*$", " ", text, flags=re.M)
    text = re.sub(r"!\[[^\]]*\]\([^)]*\)", " ", text)
    text = re.sub(r"\]\([^)]*\)", "]", text)
    return len(re.findall(r"[A-Za-z0-9][\w'’.,/-]*", text))


def symbols(formula: str) -> set[str]:
    """The letters that a formula is about, without indices and exponents: {'mu', 'n', 'R'} of \\mu = n\\cdot R_A^2."""
    formula = WORDS_INSIDE.sub(" ", formula)
    for mark in "_^":
        formula = re.sub(rf"\{mark}\s*(?:\\[A-Za-z]+|\{{(?:[^{{}}]|\{{[^{{}}]*\}})*\}}|[^\s\\{{])", " ", formula)
    commands = {name for name in re.findall(r"\\([A-Za-z]+)", formula) if name not in NO_SYMBOLS}
    letters = set(re.findall(r"[A-Za-z]", re.sub(r"\\[A-Za-z]+", " ", formula)))
    return (commands | letters) - INDICES


def formulas(text: str) -> list[tuple[int, str]]:
    """Each formula of a page and where it begins."""
    text = COMMENT.sub(blank, text)
    found = [(match.start(1), match[1]) for match in BLOCK.finditer(text)]
    text = FENCED.sub(blank, text)
    return found + [(match.start(), match[1] or match[2]) for match in INLINE.finditer(text)]


def section(text: str, heading: str) -> str:
    match = re.search(rf"^## {re.escape(heading)}\n(.*?)(?=^## |\Z)", text, re.M | re.S)
    return match[1] if match else ""


def defined(readme: str) -> set[str]:
    """The symbols in the first column of a chapter's table of symbols."""
    found: set[str] = set()
    for row in ROW.findall(section(readme, "Symbols")):
        cell = re.split(r"(?<!\\)\|", row)[0]
        for match in INLINE.finditer(cell):
            found |= symbols(match[1] or match[2])
    return found


def chapter_faults(folder: Path, root: Path) -> list[str]:
    readme = (folder / "README.md").read_text(encoding="utf-8")
    faults = []
    words = core_words(readme)
    if words > MOST_WORDS:
        faults.append(f"{folder.relative_to(root)}/README.md: {words} words; the core path has at most {MOST_WORDS}: move second readings to MORE.md")
    known = defined(readme)
    if not known:
        return [*faults, f"{folder.relative_to(root)}/README.md: no table under ## Symbols"]
    for page in sorted(folder.glob("*.md")):
        text = page.read_text(encoding="utf-8")
        missing: dict[str, int] = {}
        for at, formula in formulas(text):
            for symbol in symbols(formula) - known:
                missing.setdefault(symbol, text.count("\n", 0, at) + 1)
        faults += [f"{page.relative_to(root)}:{line}: {symbol} is in no row of the chapter's ## Symbols" for symbol, line in sorted(missing.items())]
    return faults


def old_words(glossary: str) -> dict[str, str]:
    """From the glossary's table "Not these": each word that is not used, and the word to use instead."""
    rows = [re.split(r"(?<!\\)\|", row) for row in ROW.findall(section(glossary, "Not these"))]
    return {row[0].strip(): row[1].strip() for row in rows[2:] if len(row) > 1}


def glossary_faults(pages: list[Path], root: Path) -> list[str]:
    glossary = root / "chapters/GLOSSARY.md"
    if not glossary.exists():
        return []
    faults = []
    for old, instead in old_words(glossary.read_text(encoding="utf-8")).items():
        pattern = re.compile(rf"(?<![\w`-]){re.escape(old)}(?![\w`-])", re.I)
        for page in pages:
            if page == glossary:
                continue
            text = page.read_text(encoding="utf-8")
            for removed in (COMMENT, FENCED, re.compile(r"`[^`\n]*`"), re.compile(r"\]\([^)]*\)")):
                text = removed.sub(blank, text)
            for match in pattern.finditer(text):
                faults.append(f"{page.relative_to(root)}:{text.count(chr(10), 0, match.start()) + 1}: '{match[0]}': the glossary says {instead}")
    return faults


def faults(root: Path, pages: list[Path]) -> list[str]:
    chapters = sorted(folder for folder in (root / "chapters").glob("ch*") if (folder / "README.md").exists())
    found = [fault for folder in chapters for fault in chapter_faults(folder, root)]
    return found + glossary_faults(pages, root)
