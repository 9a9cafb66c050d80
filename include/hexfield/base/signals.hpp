#pragma once

namespace hexfield {

/// Lets SIGTERM, SIGINT and SIGUSR1 ask for an orderly stop instead of ending the process. Called first thing
/// in main(), and again after libraries that install their own handlers. A second SIGINT ends the process.
void catch_stop_signals();

/// The first such signal that this process got, 0 when none. The request is per process; ranks agree on it
/// at safe points.
int stop_signal();

/// Forgets the request (for tests).
void clear_stop_signal();

}  // namespace hexfield
