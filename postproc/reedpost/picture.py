"""A picture and a set of pictures."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from matplotlib.figure import Figure

from reedpost.style import save


@dataclass
class Picture:
    """A finished figure with the words that go with it."""

    name: str  # file name without ending
    caption: str
    figure: Figure


@dataclass
class Album:
    """The pictures of one result, and what could not be drawn."""

    pictures: list[Picture] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)

    def save(self, folder: Path) -> list[Path]:
        """Write every picture as PNG and SVG."""
        folder.mkdir(parents=True, exist_ok=True)
        return [path for picture in self.pictures for path in save(picture.figure, folder / picture.name)]
