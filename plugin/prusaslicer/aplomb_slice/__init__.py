"""The stage in front of PrusaSlicer."""
