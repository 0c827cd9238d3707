"""The laws of joints with play: contact and friction."""
