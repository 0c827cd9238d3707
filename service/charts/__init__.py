"""Charts over two parameters: what they hold, values under a rectangle, and tiles of pictures."""
