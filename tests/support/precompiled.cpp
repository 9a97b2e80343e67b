// The precompiled header stands before this; what it has of functions is compiled here
// (whirl_instances).
