"""Accuracy as an input: few runs on fine meshes and many cheap ones, combined into an answer of a given error."""
