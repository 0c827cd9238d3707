"""The mechanics, written once on abstract scalars: geometry, contact, equations of motion."""
