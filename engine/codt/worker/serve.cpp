// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Answers orders until the engine is gone.
#include "engine/codt/worker/serve.h"

#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>
#include <system_error>
#include <thread>

#include "engine/codt/wire.h"

namespace mw::engine::codt {
namespace {

/// Ends the process when the engine is gone, also in the middle of a triangulation.
void watch_engine() {
  pollfd control{kControlDescriptor, 0, 0};
  while (::poll(&control, 1, -1) <= 0) {
  }
  ::_exit(0);
}

class Worker {
 public:
  explicit Worker(const Triangulate& triangulate) : triangulate_(triangulate) {}

  Reply answer(const Order& order) {
    switch (order.kind) {
      case OrderKind::kMap:
        memory_ = SharedMemory::open(order.name.data());
        return {};
      case OrderKind::kRun:
        return run();
      case OrderKind::kFetch:
        put(made_.value(), memory_.bytes());
        return {};
    }
    return {};
  }

 private:
  Reply run() {
    made_ = triangulate_(get_plc(memory_.bytes()).value());
    if (!made_) return {.kind = ReplyKind::kNoTriangulation};
    return {.kind = ReplyKind::kDone, .bytes = bytes_of(*made_)};
  }

  const Triangulate& triangulate_;
  SharedMemory memory_;
  std::optional<Triangulation> made_;
};

}  // namespace

void serve(const Triangulate& triangulate) {
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  ::signal(SIGINT, SIG_IGN);  // a terminal's Ctrl-C is for the engine
  try {
    std::thread(watch_engine).detach();
  } catch (const std::system_error&) {
    // Without a thread the end of the engine is seen only after a triangulation.
  }
  Worker worker(triangulate);
  Order order;
  try {
    while (::recv(kControlDescriptor, &order, sizeof order, 0) == sizeof order) {
      const Reply reply = worker.answer(order);
      if (::send(kControlDescriptor, &reply, sizeof reply, MSG_NOSIGNAL) != sizeof reply) return;
    }
  } catch (...) {
    ::_exit(EXIT_FAILURE);  // a lack of memory, which must not look like a crash over the request
  }
}

}  // namespace mw::engine::codt
