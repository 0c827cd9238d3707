"""Files and ends of blocks that workers hand in who are not this service's own.

They are asked for nothing but what a block needs, and nothing of it is believed.
"""
