"""Gaussian random fields: correlation functions, samplers, marginals, and the grid they are drawn on."""
