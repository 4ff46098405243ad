"""Many runs of a case whose values vary, in parallel and each once."""
