"""Micro-CT-like grey volumes: leaflets, papillary muscles and chordae, stage by stage."""

from .stages import PIPELINE

__all__ = ["PIPELINE"]
