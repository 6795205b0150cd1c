"""Sources (papers.toml) as lines of text, and as BibTeX entries."""

import re
from typing import Any

# Fields of a BibTeX entry, in the order in which they are written.
ENTRY_FIELDS = (
    "author",
    "title",
    "journal",
    "volume",
    "number",
    "pages",
    "publisher",
    "school",
    "institution",
    "howpublished",
    "version",
    "year",
    "doi",
)

# Kind of the entry of a type of source, where it has another name: the styles of BibTeX itself know no software.
ENTRY_KINDS = {"software": "misc"}

# Types of source with one author, which is an organisation: BibTeX must not take its name for that of a person.
BY_ORGANISATION = ("software", "techreport")


# Letters and signs that old styles of BibTeX do not know, as TeX has them.
IN_TEX = {"ä": r"{\"a}", "ñ": r"{\~n}", "ø": r"{\o}", "°C": "{$^\\circ$C}"}


def source_in_words(source: dict[str, Any]) -> str:
    """Return a ``source`` as a line: "authors, place (year), doi:...: what for"."""
    year = source["year"]
    authors = ", ".join(source["author"])
    doi = f", doi:{source['doi']}" if "doi" in source else ""
    if source["type"] == "software":
        words = ", ".join(filter(None, (f"lubfric {source['version']}", source.get("chapter", ""))))
    elif source["type"] == "techreport":
        words = f"{source['number']} ({year})"
    elif source["type"] == "book":
        words = f"{authors}, {source['title']}, {source['publisher']} ({year})"
    elif source["type"] == "phdthesis":
        words = f"{authors}, thesis, {source['school']} ({year})"
    elif "-" in source.get("pages", ""):
        words = f"{authors}, {source['journal']} {source['volume']} ({year}) {source['pages']}"
    else:  # an article with a number in place of pages
        number = ":".join(filter(None, (source["volume"], source.get("pages", ""))))
        words = f"{authors}, {source['journal']} {number} ({year})"
    return f"{words}{doi}: {source['purpose']}"


def bibtex(sources: list[dict[str, Any]]) -> str:
    """Return one entry for each of the ``sources``; keys are made of first author and year, and differ."""
    entries: dict[str, str] = {}
    for source in sources:
        if source["type"] == "software":
            source = source | {"howpublished": f"computer program, version {source['version']}"}
        fields = {name: _field(source, name) for name in ENTRY_FIELDS if name in source}
        name = _key(source)
        key = next(k for k in (name, *(f"{name}{letter}" for letter in "abcdefgh")) if k not in entries)
        rows = ",\n".join(f"  {field} = {{{value}}}" for field, value in fields.items())
        entries[key] = f"@{ENTRY_KINDS.get(source['type'], source['type'])}{{{key},\n{rows}\n}}"
    return "\n".join(entries.values())


def _field(source: dict[str, Any], name: str) -> str:
    """Return a field of an entry in the letters of TeX: pages with the dash of BibTeX, capitals of a title kept, authors
    joined by "and"."""
    value = source[name]
    text = str(value)
    if name == "author":
        names = " and ".join(value)
        text = f"{{{names}}}" if source["type"] in BY_ORGANISATION else names
    elif name == "title":
        text = re.sub(r"(?<!°)\b(\w*[A-Z][\w.-]*)", r"{\1}", text)
    elif name == "pages":
        text = text.replace("-", "--")
    for letter, in_tex in IN_TEX.items():
        text = text.replace(letter, in_tex)
    return text


def _key(source: dict[str, Any]) -> str:
    if source["type"] == "software":
        return "lubfric"
    if source["type"] == "techreport":
        return re.sub(r"\W", "", source["number"])
    return re.sub(r"\W", "", source["author"][0].rpartition(" ")[2]) + str(source["year"])
