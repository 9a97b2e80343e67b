// The precompiled header stands before this.
