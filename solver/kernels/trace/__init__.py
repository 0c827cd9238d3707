"""Records a scene's equations as expressions, and takes their derivatives."""
