#include "hexfield/base/signals.hpp"

#include <csignal>
#include <initializer_list>

namespace hexfield {
namespace {

// A signal handler can reach nothing but this.
volatile std::sig_atomic_t received = 0;

extern "C" void note_stop_signal(int number) {
  if (received == SIGINT && number == SIGINT) {
    std::signal(SIGINT, SIG_DFL);
    std::raise(SIGINT);
  }
  if (received == 0) received = number;
}

}  // namespace

void catch_stop_signals() {
  struct sigaction action {};
  action.sa_handler = note_stop_signal;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  for (int number : {SIGTERM, SIGINT, SIGUSR1}) sigaction(number, &action, nullptr);
  // Writing past a file size limit is an error of write(), reported like a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
}

int stop_signal() { return received; }

void clear_stop_signal() { received = 0; }

}  // namespace hexfield
