"""Result files: written as a run proceeds, read back, resumed from."""
