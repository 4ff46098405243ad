"""From one run to an answer: variants of a case side by side, sweeps, and calibration."""
