/// Lets a process die, or its disk fill up, at a chosen write: what goes to the disk is counted. Linked into
/// a test, or preloaded into a program (LD_PRELOAD) with KILL_AT_WRITE or FAIL_FROM_WRITE in the environment.
#pragma once

extern "C" {
/// The n-th write from here on is done by half, and SIGKILL ends the process; 0: none.
void kill_at_write(long n);
/// How many there were since.
long writes_so_far();
}
