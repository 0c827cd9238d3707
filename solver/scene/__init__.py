"""The scene: a mechanism as a document, its checks, parameters and structure."""
