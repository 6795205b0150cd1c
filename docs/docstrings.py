"""How docstrings become pages.

The docstrings of lubfric write a parameter as ``name : text``, with further lines indented. numpydoc takes what follows
the colon for a type. Here it is put on a line of its own, so that the page shows it as text.
"""

import dataclasses
import re

SECTIONS = ("Parameters", "Attributes", "Returns", "Raises")
ENTRY = re.compile(r"(?P<names>[\w.]+(?:, [\w.]+)*) : (?P<text>.*)")
SECOND = re.compile(r"; (?=[a-z_0-9]+ : )")  # two entries on one line


def numpydoc(lines: list[str]) -> list[str]:
    """The lines with every entry of a section as a name and an indented text."""
    out: list[str] = []
    inside = False
    for number, line in enumerate(lines):
        underlined = lines[number + 1 : number + 2] and re.fullmatch(r"-{3,}", lines[number + 1])
        if underlined:
            inside = line.strip() in SECTIONS
        elif inside and line and not line.startswith((" ", "-")):
            entries = SECOND.split(line)
            found = [ENTRY.fullmatch(entry) for entry in entries]
            if all(found):
                for k, entry in enumerate(found):
                    *before, last = entry["names"].split(", ")
                    rest = indented(lines[number + 1 :]) if k == len(found) - 1 else []
                    for name in before:  # each of them with the whole text
                        out += [name, f"    {entry['text']}", *rest]
                    out += [last, f"    {entry['text']}"]
                continue
            if not line.replace("_", "").replace(", ", "").isalnum():  # a sentence ends the section
                inside = False
                out.append("")
        out.append(line)
    return out


def indented(lines: list[str]) -> list[str]:
    """The lines that belong to the entry above them."""
    count = next((k for k, line in enumerate(lines) if not line.startswith(" ")), len(lines))
    return lines[:count]


def escaped(line: str) -> str:
    """|x| outside of literals is no substitution."""
    return "".join(part if k % 2 else part.replace("|", r"\|") for k, part in enumerate(re.split(r"(``.*?``)", line)))


def docstring(app, what, name, obj, options, lines) -> None:
    """For Sphinx's event autodoc-process-docstring, before napoleon sees the lines."""
    lines[:] = [escaped(line) for line in numpydoc(lines)]
    if what in ("property", "attribute") and lines:
        lines[0] = re.sub(r"^([^:`{]*): ", r"\1; ", lines[0])  # napoleon takes what stands before a colon for a type


def signature(app, what, name, obj, options, arguments, returned):
    """For Sphinx's event autodoc-process-signature: results are not made by hand, their fields are listed below."""
    if what == "class" and dataclasses.is_dataclass(obj) and len(dataclasses.fields(obj)) > 5:
        return "", None
    return None
