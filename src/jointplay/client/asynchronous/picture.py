"""`AsyncPicture`: a drawn figure whose `save` is awaited."""

from jointplay.client.asynchronous.verbs import awaited
from jointplay.client.notebook import Picture


class AsyncPicture:
    """A `Picture` that notebooks show; `save` may ask the service to draw it in another form."""

    def __init__(self, picture: Picture) -> None:
        self._blocking = picture
        self.content, self.form = picture.content, picture.form
        self._repr_png_, self._repr_svg_ = picture._repr_png_, picture._repr_svg_

    def __repr__(self) -> str:
        return repr(self._blocking)

    save = awaited(Picture.save)
