"""The pages of the site as tests read them: fenced code blocks, headings, links."""

import re
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "CHANGELOG.md", *sorted((ROOT / "docs").glob("*.md"))]
FENCE = re.compile(r"^(?P<fence>```+|:::+)(?P<language>.*)\n(?P<body>(?:.*\n)*?)(?P=fence)$", re.MULTILINE)
LINK = re.compile(r"\[[^\]]*\]\(<?(?P<target>[^)\s>]+)>?\)")
BARE = re.compile(r"(?<![(<\w])https?://[^\s)>\"'`]+")


@dataclass(frozen=True)
class Block:
    """One fenced block: what the fence says, and what stands inside."""

    page: Path
    language: str
    body: str
    line: int


def blocks(page: Path) -> list[Block]:
    """All fenced blocks of a page, in order."""
    text = page.read_text(encoding="utf-8")
    result = FENCE.finditer(text)
    return [Block(page, m["language"].strip(), m["body"], text[: m.start()].count("\n") + 1) for m in result]


def files(page: Path) -> dict[str, str]:
    """Files that the page asks the reader to save: a TOML block after a line that ends with the name."""
    named = re.findall(r"`([\w.]+\.toml)`:\n\n```toml\n(.*?)^```$", page.read_text("utf-8"), re.DOTALL | re.MULTILINE)
    return dict(named)


def prose(page: Path) -> str:
    """The page without its fenced blocks and quoted code."""
    return re.sub(r"`[^`\n]*`", "", FENCE.sub("", page.read_text(encoding="utf-8")))


def links(page: Path) -> list[str]:
    """Targets of all links of a page, as they are written."""
    text = prose(page)
    return [m["target"] for m in LINK.finditer(text)] + [m[0] for m in BARE.finditer(LINK.sub("", text))]


def anchors(page: Path) -> set[str]:
    """Anchors of the headings of a page, as Markdown readers make them."""
    headings = re.findall(r"^#{1,6} +(.+?) *$", FENCE.sub("", page.read_text(encoding="utf-8")), re.MULTILINE)
    plain = [re.sub(r"[^\w\- ]", "", re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", h)).strip().lower() for h in headings]
    return {h.replace(" ", "-") for h in plain}
