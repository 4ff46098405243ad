"""What a page is made of."""

import re
from html.parser import HTMLParser

VOID = {"meta", "img", "input", "br", "path"}


class Checked(HTMLParser):
    """What a page is made of; every element that opens has to close."""

    def __init__(self, text):
        super().__init__()
        self.open, self.ids, self.headings, self.links = [], [], [], []
        self.feed(text)
        assert not self.open

    def handle_starttag(self, tag, attributes):
        its = dict(attributes)
        if tag not in VOID:
            self.open.append(tag)
        if "id" in its:
            self.ids.append(its["id"])
        if re.fullmatch("h[1-6]", tag):
            self.headings.append(int(tag[1]))
        assert tag != "img" or its["alt"]
        self.links += [its[key] for key in ("src", "href") if key in its]

    def handle_startendtag(self, tag, attributes):
        pass

    def handle_endtag(self, tag):
        assert self.open.pop() == tag
