#!/usr/bin/env python3
"""make_mutants.py ROOT HEADER SOLUTION OUT MUTANT...: writes one source with all mutants of an exercise, one beside the other.

A mutant is a wrong version of the exercise's solution: NAME.MISTAKE.cpp, or NAME.MISTAKE.change, which has only the lines that
differ:

    // Caught by: Suite.Test
    // Changes: chapters/ch01_convex_advancement/clear/gjk.cpp
    <<<<
    as it stands in the source, once
    ====
    as the mistake has it
    >>>>

and more of such blocks. Without the second line it changes the exercise's solution. A clear version of a chapter becomes the
learner's by its namespace: fc::….::clear turns into fc::mine.

In the source that is written each mutant has a namespace of its own, and the functions that the exercise's header declares
call those of the mutant that the environment variable FC_MUTANT names. So the headers are read, and their templates are
instantiated, once and not once for each mutant. Ends with 1 and a line if a source has changed so that a block does not fit."""

import re
import sys
from pathlib import Path

BLOCK = re.compile(r"^<<<<\n(.*?)^====\n(.*?)^>>>>$", re.M | re.S)
CLEAR = re.compile(r"^namespace (fc(?:::\w+)*)::clear \{$", re.M)
LEARNERS = re.compile(r"^namespace (fc::(?:mine|exercises)) \{$", re.M)
INCLUDE = re.compile(r"^#include .*\n", re.M)
# A function that is declared and not defined: what returns, its name, its parameters.
DECLARED = re.compile(r"^(?!using |struct |class |inline |template|constexpr |extern )([A-Za-z][^;{}()=]*?)\b(\w+)\(([^;{}]*)\);", re.M)


def changed(root: Path, change: Path, solution: Path) -> str:
    """The mutant that a change describes, as a file of its own."""
    text = change.read_text(encoding="utf-8")
    named = re.search(r"^// Changes: (\S+)$", text, re.M)
    source = root / named[1] if named else solution
    result = source.read_text(encoding="utf-8")
    blocks = BLOCK.findall(text)
    if not blocks:
        raise ValueError(f"{change}: no block from <<<< over ==== to >>>>")
    for old, new in blocks:
        if result.count(old) != 1:
            raise ValueError(f"{change}: stands {result.count(old)} times in {source}, and must once:\n{old}")
        result = result.replace(old, new)
    return CLEAR.sub(r"namespace fc::mine {\nusing namespace \1;\nusing namespace \1::clear;", result)


def declarations(header: str) -> list[tuple[str, str, str]]:
    """Of each function that the learner writes: what it returns, its name, its parameters."""
    return DECLARED.findall(re.sub(r"[ \t]*//.*", "", header))


def split(parameters: str) -> list[str]:
    """At the commas that no bracket holds."""
    parts, depth = [""], 0
    for letter in parameters:
        depth += (letter in "<({") - (letter in ">)}")
        if letter == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    return [part.strip() for part in parts if part.strip()]


def dispatcher(declared: list[tuple[str, str, str]], mistakes: list[str]) -> str:
    """The functions of the header, as calls of the mutant's."""
    result = ""
    for returns, name, parameters in declared:
        given = [part.split("=")[0].strip() for part in split(parameters)]
        names = ", ".join(re.search(r"(\w+)$", part)[1] for part in given)
        calls = "".join(f"    case {k}: return mutant_{mistake}::mutated_{name}({names});\n" for k, mistake in enumerate(mistakes))
        result += f"{returns}{name}({', '.join(given)}) {{\n  switch (chosen()) {{\n{calls}    default: std::abort();\n  }}\n}}\n"
    return result


def bundle(root: Path, header: Path, solution: Path, mutants: list[Path]) -> str:
    header_text = header.read_text(encoding="utf-8")
    space = LEARNERS.search(header_text)[1]
    declared = declarations(header_text)
    renamed = re.compile(r"(?<![\w.:>])(" + "|".join(name for _, name, _ in declared) + r")(?=\()")
    own = "".join(f"{returns}{name}({parameters});\n" for returns, name, parameters in declared)
    includes, bodies, mistakes = [f'#include "{header.name}"\n', "#include <array>\n", "#include <cstdlib>\n", "#include <string_view>\n"], "", []
    for mutant in mutants:
        text = changed(root, mutant, solution) if mutant.suffix == ".change" else mutant.read_text(encoding="utf-8")
        includes += INCLUDE.findall(text)
        mistakes.append(mutant.stem.split(".", 1)[1])
        text = INCLUDE.sub("", text)
        opened = f"namespace {space}::mutant_{mistakes[-1]} {{\n{own}"
        if len(LEARNERS.findall(text)) != 1:
            raise ValueError(f"{mutant}: it must open the namespace {space} once")
        bodies += renamed.sub(r"mutated_\1", LEARNERS.sub(lambda _: opened, text)) + "\n"
    listed = ", ".join(f'"{mistake}"' for mistake in mistakes)
    return f"""// Made by make_mutants.py.
{''.join(dict.fromkeys(includes))}
{bodies}
namespace {space} {{

static int chosen() {{
  static const int result = [] {{
    constexpr std::array<std::string_view, {len(mistakes)}> mistakes{{{listed}}};
    const char* name = std::getenv("FC_MUTANT");
    for (std::size_t k = 0; k < mistakes.size(); ++k)
      if (name && mistakes[k] == name) return static_cast<int>(k);
    std::exit(0);  // a test that must fail does not
  }}();
  return result;
}}

{dispatcher(declared, mistakes)}
}}
"""


def main() -> int:
    root, header, solution, out, *mutants = map(Path, sys.argv[1:])
    try:
        text = bundle(root, header, solution, mutants)
    except (OSError, ValueError) as error:
        print(f"make_mutants.py: {error}", file=sys.stderr)
        return 1
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
