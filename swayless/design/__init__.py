"""Shapers as pure mathematics: what they leave swinging, what they guarantee, and how they are found."""
