"""What a release writes, whom it installs for, and that it leaves nothing behind where it fails."""

import re
import shutil
import subprocess
import sys
from pathlib import Path
from unittest.mock import Mock

import pytest
import release
from release import ReleaseError, cut

PROJECT = Path(__file__).parents[1]
CHANGELOG = "# Changelog\n\nWords.\n\n## Unreleased\n\n- New.\n\n## 0.1.0 · 2026-01-02\n\n- Old.\n"
FITS = re.search(r"^FITS := (.*)$", (PROJECT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE)[1]


def test_the_changelog_is_cut_where_it_is_unreleased():
    assert cut(CHANGELOG, "0.2.0", "2026-03-04") == CHANGELOG.replace("## Unreleased", "## 0.2.0 · 2026-03-04")


@pytest.fixture
def tree(tmp_path, monkeypatch):
    """A repository with the files that a release changes, committed."""
    for name in ("CHANGELOG.md", release.VERSION_FILE, "CITATION.cff"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(PROJECT / name, tmp_path / name)
    (tmp_path / "CHANGELOG.md").write_text(CHANGELOG, encoding="utf-8")
    (tmp_path / ".gitignore").write_text("/dist/\n", encoding="utf-8")
    for words in (["init", "-q"], ["config", "user.name", "a"], ["config", "user.email", "a@b"], ["add", "."]):
        git(tmp_path, *words)
    git(tmp_path, "commit", "-q", "-m", "before")
    monkeypatch.setattr(release, "PROJECT", tmp_path)
    return tmp_path


def git(tree, *words):
    return subprocess.run(["git", *words], cwd=tree, check=True, capture_output=True, text=True).stdout


def built(folder):
    folder.mkdir()
    (folder / "colonnade-0.2.0.tar.gz").write_text("built")
    return folder


def test_a_release_is_a_commit_and_a_tag_with_what_was_built(tree, monkeypatch, capsys):
    monkeypatch.setattr(release, "build", built)
    monkeypatch.setattr(release, "install", lambda *arguments: None)
    release.release("0.2.0", [sys.executable], FITS)
    assert git(tree, "tag").split() == ["v0.2.0"]
    assert git(tree, "status", "--porcelain") == ""
    assert '__version__ = "0.2.0"' in (tree / release.VERSION_FILE).read_text(encoding="utf-8")
    assert (tree / "dist" / "colonnade-0.2.0.tar.gz").read_text() == "built"
    with pytest.raises(ReleaseError, match=r"tag v0\.2\.0 is there already"):
        release.release("0.2.0", [sys.executable], FITS)


def test_a_release_that_fails_leaves_the_tree_as_before(tree, monkeypatch, capsys):
    before = git(tree, "rev-parse", "HEAD")
    monkeypatch.setattr(release, "build", built)
    monkeypatch.setattr(release, "install", Mock(side_effect=KeyboardInterrupt))
    with pytest.raises(KeyboardInterrupt):
        release.release("0.2.0", [sys.executable], FITS)
    assert (git(tree, "rev-parse", "HEAD"), git(tree, "status", "--porcelain"), git(tree, "tag")) == (before, "", "")
    assert (tree / "CHANGELOG.md").read_text(encoding="utf-8") == CHANGELOG
    assert not (tree / "dist").exists()
