"""The ideal mechanism: nothing moves freely, so kinematics and inverse dynamics suffice."""
