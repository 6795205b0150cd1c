"""Papers as BibTeX entries, from their lines in papers.toml: "authors, place year, doi: what for"."""

import re

AUTHOR = re.compile(r"(?:[A-Z]\.(?:-[A-Z]\.)?\s?)+(?:(?:van|de|den|der)\s)?[A-Z][\w'-]+")
YEAR = re.compile(r"\((?:[^()]*\s)?(\d{4})\)")
DOI = re.compile(r"doi:(10\.\S+?)(?=[:,;\s]|$)")


def bibtex(lines: list[str]) -> str:
    """Return one entry for each of ``lines``; keys are made of first author and year, and differ."""
    entries: dict[str, str] = {}
    for line in lines:
        source, _, purpose = line.rpartition(": ")
        fields = {"author": " and ".join(_authors(source))}
        year = YEAR.search(source)
        doi = DOI.search(source)
        place = DOI.sub("", source.removeprefix(", ".join(_authors(source)))).strip(" ,")
        fields |= {"howpublished": YEAR.sub("", place).strip(" ,"), "year": year[1] if year else ""}
        fields |= {"doi": doi[1] if doi else "", "note": purpose}
        first = fields["author"].partition(" and ")[0].rpartition(" ")[2] or "lubfric"
        name = re.sub(r"\W", "", first) + fields["year"]
        key = next(k for k in (name, *(f"{name}{letter}" for letter in "abcdefgh")) if k not in entries)
        rows = ",\n".join(f"  {field} = {{{value}}}" for field, value in fields.items() if value)
        entries[key] = f"@misc{{{key},\n{rows}\n}}"
    return "\n".join(entries.values())


def _authors(source: str) -> list[str]:
    """Return the authors at the begin of ``source``."""
    names = []
    for part in source.split(", "):
        if not AUTHOR.fullmatch(part):
            break
        names.append(part)
    return names
