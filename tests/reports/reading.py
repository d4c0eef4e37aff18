"""Reads a report as a machine would: its tables, its figures, what it refers to."""

import base64
import gzip
import json
import struct
from html.parser import HTMLParser

import numpy as np

from fmu_bearing.engine.constants import RPM
from fmu_bearing.recording.recording import Recording
from fmu_bearing.reports.data.subject import Subject


def not_run(scene):
    """What sections read that need no run: a scene at its speed, for 1 s, without variables."""
    speed = np.full(2, scene.operation.speed_rpm * RPM)
    recording = Recording(scene, "compact", 51_200.0, 0.0, 51_200, np.array([0.0, 1.0]), speed)
    return Subject(recording, "compact")


def numbers(value):
    """An array out of a figure, as the page packs it or as a list."""
    return np.asarray(value, dtype=float)


def restored(text):
    """Figures by key out of a page's compressed text."""
    data = gzip.decompress(base64.b64decode(text))
    (size,) = struct.unpack("<I", data[:4])
    arrays = np.frombuffer(data[4 + size :], np.uint8)

    def array(found):
        if "packed" not in found:
            return found
        kind, place, count, shape = found["packed"]
        wide = np.dtype(kind).itemsize
        flat = np.ascontiguousarray(arrays[place : place + count * wide].reshape(wide, count).T)
        return flat.view(kind).reshape(shape)

    return json.loads(data[4 : 4 + size], object_hook=array)


class Page(HTMLParser):
    """Tables by caption, figures by key, texts by class of paragraph, addresses, sounds."""

    def __init__(self, path):
        super().__init__()
        self.text = path.read_text("utf-8")
        self.tables, self.figures, self.paragraphs, self.addresses, self.sounds = {}, {}, [], [], []
        self.sections, self.headings, self.ids, self.libraries = {}, [], [], []
        self._tag, self._words, self._rows, self._script = "", "", [], ""
        self.feed(self.text)

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        self.ids += [found["id"]] if "id" in found else []
        self.addresses += [found[name] for name in ("src", "href", "poster", "action") if name in found]
        if tag == "section":
            self._section = found["id"]
            self.sections[self._section] = ""
        if tag == "audio":
            self.sounds.append(base64.b64decode(found["src"].split(",", 1)[1]))
        if tag == "script":
            self._script = found.get("id", "")
        if tag == "table":
            self._rows = []
        if tag == "tr":
            self._rows.append([])
        if tag in ("td", "th", "caption", "p", "h1", "h2", "h3"):
            self._words = ""
        self._tag = tag

    def handle_data(self, data):
        if self._tag == "script" and self._script in ("figures", "library"):
            if self._script == "figures":
                self.figures = restored(data)
            else:
                self.libraries.append(gzip.decompress(base64.b64decode(data)).decode("utf-8"))
            self._script = ""
        elif self._tag not in ("script", "style"):
            self._words += data
            if self.sections:
                self.sections[self._section] += data

    def handle_endtag(self, tag):
        if tag in ("td", "th"):
            self._rows[-1].append(self._words.strip())
        elif tag == "caption":
            self._caption = self._words.strip()
        elif tag == "table":
            self.tables[self._caption] = self._rows
        elif tag == "p":
            self.paragraphs.append(self._words.strip())
        elif tag in ("h1", "h2", "h3"):
            self.headings.append((int(tag[1]), self._words.strip()))
        self._tag = ""

    def traces(self, key, **meta):
        """Traces of a figure whose ``meta`` agrees."""
        found = []
        for trace in self.figures[key]["data"]:
            has = trace.get("meta") or {}
            if all(has.get(name) == value for name, value in meta.items()):
                found.append(trace)
        return found
