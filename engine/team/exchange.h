// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Messages between the processes of a run.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace mw::engine {

/// Four numbers in front of a message's bytes.  The first is the message's kind; TakeRoom is called
/// for kinds from 1 to kMaxKind.  The sender chooses what the others mean.
using MessageHead = std::array<std::uint64_t, 4>;

inline constexpr std::uint64_t kMaxKind = 255;

/// Bytes that are shared with the thread that waits until they are sent.
using SharedBytes = std::shared_ptr<const std::vector<std::byte>>;

/// A message that came in.
struct Message {
  int from = 0;
  MessageHead head{};
  std::vector<std::byte> bytes;
  std::shared_ptr<void> room;  ///< what TakeRoom returned for the bytes
};

/// Takes messages, one at a time.  It must not wait for other messages.
using OnMessage = std::function<void(Message message)>;

/// Takes room in a budget for the bytes of a message of this kind, before they are in memory.
/// Returns null where there is no room or none is counted; the message comes all the same.  It must
/// not wait for other messages.
using TakeRoom = std::function<std::shared_ptr<void>(std::uint64_t kind, std::uint64_t bytes)>;

/// Callbacks for messages that come in and bytes that have left.
struct ExchangeListener {
  OnMessage receive;           ///< if empty, messages are kept
  TakeRoom room;               ///< optional; one call at a time, never beside `receive`
  std::function<void()> sent;  ///< optional; called from time to time when bytes have left
};

/// Carries messages between `ranks()` processes, each one exactly once, in any order.
/// Thread safety: all members except listen() may be called from many threads.
class Exchange {
 public:
  virtual ~Exchange() = default;

  [[nodiscard]] virtual int rank() const = 0;
  [[nodiscard]] virtual int ranks() const = 0;
  /// Returns how many of the processes share this machine's memory and cores.
  [[nodiscard]] virtual int ranks_here() const = 0;

  /// Returns at once; the bytes are released when they have left.  REQUIRES: to != rank().
  virtual void send(int to, const MessageHead& head, SharedBytes bytes) = 0;
  /// True if all that was sent has left.
  [[nodiscard]] virtual bool is_idle() const = 0;
  /// Releases bytes even if they have not left yet.  Where that is impossible, it waits, or keeps
  /// them for ever.  ENSURES: bytes that were sent before are not released any more.
  virtual void let_go() = 0;
  /// Gives messages to this listener from now on, first those that came before.
  /// ENSURES: the former listener is not called any more.
  virtual void listen(ExchangeListener listener) = 0;
};

}  // namespace mw::engine
