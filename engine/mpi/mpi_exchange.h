// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Messages by MPI.
#pragma once

#include <memory>

#include "engine/team/team.h"

namespace mw::engine {

/// The processes that mpirun, or srun, has started.  A thread of its own starts MPI, makes all
/// calls to it and ends it, so MPI_THREAD_FUNNELED suffices.  It sends and receives without copies,
/// and sleeps when there is nothing to do.
///
/// Every rank sends a message to every other each second.  When a rank has been silent for kSilence
/// this process ends (exit code 1), since Open MPI itself waits for ever when a network is cut.
class MpiExchange : public Exchange {
 public:
  static constexpr int kSilence = 30;  ///< seconds

  /// A process may make only one.  ERRORS: mw::Error(kInternal) when MPI cannot be started.
  MpiExchange();
  ~MpiExchange() override;

  [[nodiscard]] int rank() const override;
  [[nodiscard]] int ranks() const override;
  [[nodiscard]] int ranks_here() const override;
  void send(int to, const MessageHead& head, SharedBytes bytes) override;
  [[nodiscard]] bool is_idle() const override;
  void let_go() override;
  void listen(ExchangeListener listener) override;

  /// Ends the program with this exit code.  If it is 0 on all ranks, MPI is ended in order.  After
  /// an error the other ranks, which have been told, get some seconds to clean up; then this
  /// process ends, rank 0 first, and mpirun ends with the same code.
  [[noreturn]] void leave(int code);

 private:
  class Transport;

  std::unique_ptr<Transport> transport_;
};

}  // namespace mw::engine
