"""From one run to an answer: variants of a case, set side by side."""
