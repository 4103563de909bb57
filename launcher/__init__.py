"""The launcher: sets the machine up, builds, starts the programs of a run and watches them, draws results."""
