"""
Code blocks of a documentation page, run in the order in which a reader meets them, in a folder that starts empty.

- `sh`: line by line. `colonnade` is called in this process; `make TARGET` only has to be a target; bash has the rest.
- `python`: executed in one namespace a page; lines with `>>>` are a doctest.
- `toml`: what is written has to be valid in campaign.toml or review.toml, even if it is only a part of one.
- other languages: shown only.

A remark above a block, invisible to the reader, says more:

- `<!-- not run: REASON -->`
- `<!-- file: PATH -->`, `<!-- append: PATH -->`: the reader writes the block into this file, or at its end.
- `<!-- with: FILE -->`: the reader has saved this file, which is next to the page, into the folder.
- `<!-- exit code: 1 -->`: that of the last command of the block, if it is not 0.
- `<!-- output -->`: the lines of the block are in the output of the block that ran last, in order; `…` is anything.
"""

import contextlib
import doctest
import io
import os
import re
import shlex
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from unittest import mock

from pydantic import ValidationError

from colonnade.campaign.campaign import CampaignFile
from colonnade.campaign.review import ReviewFile
from colonnade.cli import invoke

PROJECT = Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"(?:^<!-- (?P<remark>[^\n]*?) -->\n+)?^```(?P<language>\w*)\n(?P<text>.*?)^```$", re.M | re.S)
REMARKS = ("not run", "file", "append", "with", "exit code", "output")
ENTRIES = ("exclude", "trim", "flag", "correct")
"""Tables of review.toml."""


@dataclass(frozen=True)
class Block:
    """A fenced block of a page, with the remark above it."""

    place: str
    language: str
    text: str
    remark: str = ""
    value: str = ""
    folder: Path = PROJECT


def blocks_of(page):
    """Find the blocks of a page; a remark that nobody knows is an error."""
    source = page.read_text(encoding="utf-8")
    found = []
    for match in BLOCK.finditer(source):
        remark, _, value = (match["remark"] or "").partition(": ")
        place = f"{page.name}, line {source.count(chr(10), 0, match.start('language')) + 1}"
        if remark and remark not in REMARKS:
            raise ValueError(f'{place}: unknown remark "{remark}"; known: {", ".join(REMARKS)}')
        if remark == "not run" and not value:
            raise ValueError(f"{place}: say why it is not run: <!-- not run: REASON -->")
        found.append(Block(place, match["language"], match["text"], remark, value, page.parent))
    return found


@dataclass
class Reader:
    """
    Someone who types what a page says.

    `instead` may take a command, as a list of words, and give its output if it knows a quicker way to the same files.
    """

    folder: Path
    instead: Callable[[list[str], Path], str | None] = lambda words, folder: None
    output: str = ""
    names: dict[str, Any] = field(default_factory=lambda: {"__name__": "page"})

    def follow(self, page):
        """Do all that a page says."""
        for block in blocks_of(page):
            self.do(block)

    def do(self, block):
        """Do what a block says."""
        if block.remark == "not run":
            return
        if block.remark == "with":
            shutil.copy(block.folder / block.value, self.folder)
        if block.remark == "output":
            assert_shown(block, self.output)
        elif block.remark in ("file", "append"):
            self._write(block)
        elif block.language == "sh":
            self._type(block)
        elif block.language == "python":
            self.output = self._execute(block)
        elif block.language == "toml":
            assert_valid(block)

    def _write(self, block):
        path = self.folder / block.value
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open("a" if block.remark == "append" else "w", encoding="utf-8") as stream:
            stream.write(("\n" if block.remark == "append" else "") + block.text)

    def _type(self, block):
        printed = []
        lines = [line for line in block.text.replace("\\\n", " ").splitlines() if line and not line.startswith("#")]
        for line in lines:
            expected = int(block.value) if block.remark == "exit code" and line == lines[-1] else 0
            code, out = self._command(line)
            printed.append(out)
            assert code == expected, f"{block.place}: `{line}` ended with {code}\n{out}"
        self.output = "".join(printed)

    def _command(self, line):
        words = shlex.split(line, comments=True)
        if words[0] == "make":
            return int(words[1] not in make_targets()), "not a target of the Makefile"
        if words[0] == "cd":
            self.folder = self.folder / words[1]
            return int(not self.folder.is_dir()), f"{self.folder} is not a folder"
        if (done := self.instead(words, self.folder)) is not None:
            return 0, done
        if words[0] == "colonnade" and not {"|", ">", "&&", ";"}.intersection(words):
            return self._called(words[1:])
        path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
        done = subprocess.run(
            ["bash", "-c", line],
            cwd=self.folder,
            env=os.environ | {"PATH": path},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            encoding="utf-8",
        )
        return done.returncode, done.stdout

    def _called(self, arguments):
        out = io.StringIO()
        with contextlib.chdir(self.folder), contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
            code = invoke(arguments)
        return code, out.getvalue()

    def _execute(self, block):
        out = io.StringIO()
        # Modules in this folder can be imported, as by a Python that was started in it.
        importable = mock.patch.object(sys, "path", [str(self.folder), *sys.path])
        with contextlib.chdir(self.folder), contextlib.redirect_stdout(out), importable:
            if block.text.startswith(">>> "):
                test = doctest.DocTestParser().get_doctest(block.text, self.names, block.place, None, None)
                results = doctest.DocTestRunner().run(test, out=out.write, clear_globs=False)
                assert results.failed == 0, f"{block.place}\n{out.getvalue()}"
                self.names.update(test.globs)
            else:
                exec(compile(block.text, block.place, "exec"), self.names)
        return out.getvalue()


def make_targets():
    """Targets that the Makefile announces."""
    [listed] = re.findall(r"^\.PHONY: (.*)$", (PROJECT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE)
    return set(listed.split())


def assert_shown(block, output):
    """Hold the lines of a block against what was printed, spaces aside."""
    printed, at = squeezed(output), 0
    for line in filter(None, squeezed(block.text).splitlines()):
        match = re.compile(".*?".join(map(re.escape, line.split("…")))).search(printed, at)
        assert match, f"{block.place}: not in the output, or not in this order: {line}\n{output}"
        at = match.end()


def squeezed(text):
    """Text without repeated spaces and without spaces at the ends of lines."""
    return "\n".join(" ".join(line.split()) for line in text.splitlines())


def assert_valid(block):
    """Hold a part of campaign.toml or review.toml against its model; what the part leaves out is not missed."""
    document = tomllib.loads(block.text)
    model = ReviewFile if set(ENTRIES) & document.keys() else CampaignFile
    try:
        model.model_validate(document)
    except ValidationError as refused:
        wrong = [each for each in refused.errors() if not each["msg"].startswith("It is missing.")]
        assert not wrong, f"{block.place}: {wrong}"
