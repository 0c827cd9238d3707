"""What a graphics processor makes of three mechanisms: its bits, and its revolutions a second."""
