"""Volumes, label maps and landmarks of patients."""
