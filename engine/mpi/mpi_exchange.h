// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Messages by MPI.
#pragma once

#include <memory>

#include "engine/team/exchange.h"

namespace mw::engine {

/// The processes that mpirun, or srun, has started.  One thread of its own starts MPI, makes all of
/// its calls and ends it, so any level of thread support does (MPI_THREAD_FUNNELED).  It sends and
/// receives without copies, and sleeps when there is nothing to do.
///
/// Every rank hears from every other at least each second.  After kSilence without a word from one
/// this process ends (exit code 1): Open MPI itself waits for ever when a network is cut.
class MpiExchange : public Exchange {
 public:
  static constexpr int kSilence = 30;  ///< seconds

  /// Once a process.  ERRORS: mw::Error(kInternal) when MPI cannot be started.
  MpiExchange();
  ~MpiExchange() override;

  [[nodiscard]] int rank() const override;
  [[nodiscard]] int ranks() const override;
  [[nodiscard]] int ranks_here() const override;
  void send(int to, const MessageHead& head, SharedBytes bytes) override;
  [[nodiscard]] bool is_idle() const override;
  void let_go() override;
  void listen(ExchangeListener listener) override;

  /// The end of the program with this exit code.  After 0 everywhere MPI is ended in order.  After
  /// an error the other ranks, which have been told, get some seconds to put their things away;
  /// then this process ends, rank 0 first, and mpirun ends with the same code.
  [[noreturn]] void leave(int code);

 private:
  class Transport;

  std::unique_ptr<Transport> transport_;
};

}  // namespace mw::engine
