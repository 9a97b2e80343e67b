// Carries the precompiled header of the tests; nothing of its own.
