"""All reports share one frame: each kind has its sections alone."""

from html.parser import HTMLParser
from importlib.resources import files
from string import Template

import pytest

from lubfric.output import FRAME, framed

SECTIONS = ("report.html", "study_report.html", "run_in_report.html", "fit_report.html")
OF_FRAME = ("<!DOCTYPE", "<html", "<head", "<body", "<h1", 'class="status', "<h2>Answer</h2>")


class Tags(HTMLParser):
    """The headings of a page, in order, and the tags that are open at its end."""

    def __init__(self):
        super().__init__()
        self.open = []
        self.headings = []

    def handle_starttag(self, tag, attributes):
        self.open += [] if tag in ("meta", "br") else [tag]

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, text):
        if self.open and self.open[-1] in ("h1", "h2"):
            self.headings.append(text)


@pytest.mark.parametrize("sections", SECTIONS)
def test_a_report_is_its_sections_in_the_frame_of_all(sections):
    own = (files("lubfric.output") / sections).read_text(encoding="utf-8")
    assert not [part for part in OF_FRAME if part in own]
    parts = {name: f"[{name}]" for name in (*FRAME, *Template(own).get_identifiers())}
    page = framed(sections, "a < b", "on a day", parts).decode()
    assert all(page.count(part) == 1 for part in OF_FRAME)
    assert all(text in page for text in parts.values()) and "$" not in page and '<p class="small">on a day</p>' in page
    tags = Tags()
    tags.feed(page)
    assert tags.open == [] and tags.headings[:2] == ["[name]: a < b", "Answer"]
    assert tags.headings[-1] == "Reproducibility"


def test_every_page_of_the_package_is_the_frame_or_sections_of_one_report():
    pages = {file.name for file in files("lubfric.output").iterdir() if file.name.endswith(".html")}
    assert pages == {"page.html", *SECTIONS}
