// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The processes of a run, and the messages that they send one another beside blocks.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstring>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/team/exchange.h"
#include "kernels/core/error.h"

namespace mw::engine {

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
  /// Sends mine[r] to each rank r, and returns what every rank sent to this one, by rank.  Counts
  /// as a call of gather().  REQUIRES: mine.size() == ranks().  ERRORS: those of gather().
  [[nodiscard]] std::vector<std::vector<std::byte>> trade(std::vector<std::vector<std::byte>> mine,
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
