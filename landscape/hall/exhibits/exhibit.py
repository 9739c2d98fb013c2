"""What an exhibit is: an element that can also be drawn without its effect."""

from landscape.elements.element import Element
from landscape.frame import Frame
from landscape.hall.settings import Settings


class Exhibit(Element[Settings]):
    """The model in an alcove, and the effect that it shows."""

    def draw_plain(self, frame: Frame) -> None:
        """Draw the model without the effect: mirrored, or from afar."""
        raise NotImplementedError
