// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The processes of a run, and the messages that they send one another beside blocks.
#pragma once

#include <array>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "kernels/core/error.h"

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

/// Sorts messages: parcels go to the listener, the others are for the team itself.
/// Thread safety: send(), signal(), fail(), failure() and has_failed() from any thread; the others
/// from one, or from one for each Channel.
class Team {
 public:
  /// exchange outlives it.
  explicit Team(Exchange& exchange);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  [[nodiscard]] int rank() const { return exchange_.rank(); }
  [[nodiscard]] int ranks() const { return exchange_.ranks(); }
  [[nodiscard]] bool is_first() const { return rank() == 0; }
  [[nodiscard]] int ranks_here() const { return exchange_.ranks_here(); }

  /// Two threads of a rank may gather at the same time, each on a channel of its own.
  enum class Channel : std::uint8_t { kRun, kEpochs };

  /// Returns what every rank passed to it, by rank.  On each channel all ranks must call it equally
  /// often.  ERRORS: that of the rank that failed, which may be this one.
  [[nodiscard]] std::vector<std::vector<std::byte>> gather(std::vector<std::byte> mine,
                                                           Channel channel = Channel::kRun);
  /// Gathers texts.
  [[nodiscard]] std::vector<std::string> gather(const std::string& mine);

  /// Numbers that the sender chooses.
  using Head = std::array<std::uint64_t, 3>;
  /// room is what Listener::room returned for these bytes.
  using OnParcel = std::function<void(const Head& head, std::vector<std::byte> bytes,
                                      std::shared_ptr<void> room)>;
  void send(int to, const Head& head, SharedBytes bytes);
  /// Sends a number to the listeners of all other ranks.
  void signal(std::uint64_t number);
  [[nodiscard]] bool is_idle() const { return exchange_.is_idle(); }
  void let_go() { exchange_.let_go(); }

  /// Callbacks for parcels (one at a time), for bytes that have left, and for a rank's failure.
  struct Listener {
    OnParcel parcel;
    /// Optional, see TakeRoom.  It is called before a parcel's bytes are in memory, except for
    /// parcels that came before there was a listener.
    std::function<std::shared_ptr<void>(std::uint64_t bytes)> room;
    std::function<void(std::uint64_t number)> signalled;
    std::function<void()> sent;
    std::function<void(const Error& error)> failed;
  };
  /// Sets the listener, and gives it the parcels that wait.  ENSURES: the former one is not called.
  void listen(Listener listener);

  /// Tells all ranks that this one cannot go on, and which rank it is.  Does nothing when a rank is
  /// known to have failed already.
  void fail(const Error& error);
  void fail(const std::exception_ptr& error);
  /// Returns the failure of another rank, if that is why this one ends.
  [[nodiscard]] std::optional<Error> failure() const;
  /// True if any rank has failed, this one or another.
  [[nodiscard]] bool has_failed() const;

 private:
  using Gathering = std::pair<Channel, std::uint64_t>;

  [[nodiscard]] Gathering next_gathering(Channel channel);
  void say(int to, const Gathering& gathering, SharedBytes bytes);
  /// Returns what the other ranks say, by rank; the entry of this rank is empty.
  [[nodiscard]] std::vector<std::vector<std::byte>> hear(const Gathering& gathering);
  void receive(Message message);
  [[nodiscard]] std::shared_ptr<void> take_room(std::uint64_t kind, std::uint64_t bytes);
  void note_failure(const Error& error);

  Exchange& exchange_;
  mutable std::mutex mutex_;  ///< guards the rest except waiting_ and listener_
  std::condition_variable changed_;
  std::map<Gathering, std::map<int, std::vector<std::byte>>> said_;  ///< by rank
  std::map<Channel, std::uint64_t> gatherings_;
  std::vector<Message> waiting_;  ///< for a listener to come; guarded by listening_
  std::optional<Error> failure_;
  std::optional<Error> own_failure_;

  std::mutex listening_;  ///< guards the next line; never taken inside mutex_
  Listener listener_;
};

template <typename T>
[[nodiscard]] std::vector<std::byte> bytes_of(const T* first, std::size_t count) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::vector<std::byte> out(count * sizeof(T));
  if (count > 0) std::memcpy(out.data(), first, out.size());
  return out;
}

template <typename T>
[[nodiscard]] std::vector<T> list_of(const std::vector<std::byte>& bytes) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::vector<T> out(bytes.size() / sizeof(T));
  if (!out.empty()) std::memcpy(out.data(), bytes.data(), out.size() * sizeof(T));
  return out;
}

}  // namespace mw::engine
