// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A letter box a rank, emptied by its postman when letters are due.
#include "tests/engine/team/thread_exchange.h"

#include <condition_variable>
#include <map>
#include <mutex>
#include <random>
#include <thread>

namespace mw::engine {
namespace {

using Clock = std::chrono::steady_clock;

struct Letter {
  Message message;
  std::function<void()> delivered;
};

/// Letters in the order in which they are due.
class LetterBox {
 public:
  LetterBox() : postman_([this] { deliver(); }) {}
  LetterBox(const LetterBox&) = delete;
  LetterBox& operator=(const LetterBox&) = delete;
  ~LetterBox() {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
    }
    changed_.notify_all();
    postman_.join();
  }

  void put(Clock::time_point due, Letter letter) {
    {
      const std::lock_guard lock(mutex_);
      letters_.emplace(due, std::move(letter));
    }
    changed_.notify_all();
  }

  void listen(OnMessage receive, TakeRoom room) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !at_work_; });
    receive_ = std::move(receive);
    room_ = std::move(room);
    changed_.notify_all();
  }

 private:
  void deliver() {
    std::unique_lock lock(mutex_);
    while (!closed_) {
      if (letters_.empty() || !receive_) {
        changed_.wait(lock);
        continue;
      }
      const Clock::time_point due = letters_.begin()->first;
      if (due > Clock::now()) {
        changed_.wait_until(lock, due);
        continue;
      }
      Letter letter = std::move(letters_.begin()->second);
      letters_.erase(letters_.begin());
      at_work_ = true;
      lock.unlock();
      Message& message = letter.message;
      if (room_) message.room = room_(message.head[0], message.bytes.size());
      receive_(std::move(message));
      letter.delivered();
      lock.lock();
      at_work_ = false;
      changed_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::multimap<Clock::time_point, Letter> letters_;
  OnMessage receive_;
  TakeRoom room_;
  bool at_work_ = false;
  bool closed_ = false;
  std::thread postman_;
};

/// What the ranks share.
struct Office {
  explicit Office(const ThreadExchangeOptions& given)
      : options(given), boxes(static_cast<std::size_t>(given.ranks)), random(given.seed) {
    for (auto& box : boxes) box = std::make_unique<LetterBox>();
  }

  Clock::time_point due() {
    const std::lock_guard lock(mutex);
    std::uniform_int_distribution<std::int64_t> delay(0, options.max_delay.count());
    return Clock::now() + std::chrono::microseconds(delay(random));
  }

  ThreadExchangeOptions options;
  std::vector<std::unique_ptr<LetterBox>> boxes;
  std::mutex mutex;
  std::mt19937 random;
};

class ThreadExchange : public Exchange {
 public:
  ThreadExchange(std::shared_ptr<Office> office, int rank)
      : office_(std::move(office)), rank_(rank), sending_(std::make_shared<Sending>()) {}
  ~ThreadExchange() override { listen({}); }

  [[nodiscard]] int rank() const override { return rank_; }
  [[nodiscard]] int ranks() const override { return office_->options.ranks; }
  [[nodiscard]] int ranks_here() const override { return ranks(); }

  void send(int to, const MessageHead& head, SharedBytes bytes) override {
    Letter letter{.message = {.from = rank_, .head = head, .bytes = {}}, .delivered = {}};
    if (bytes != nullptr) letter.message.bytes = *bytes;
    const std::uint64_t number = sending_->hold(std::move(bytes));
    letter.delivered = [sending = sending_, number] { sending->delivered(number); };
    office_->boxes[static_cast<std::size_t>(to)]->put(office_->due(), std::move(letter));
  }
  [[nodiscard]] bool is_idle() const override {
    const std::lock_guard lock(sending_->mutex);
    return sending_->held.empty();
  }
  void let_go() override {
    const std::lock_guard lock(sending_->mutex);
    sending_->held.clear();
  }
  void listen(ExchangeListener listener) override {
    {
      const std::lock_guard lock(sending_->telling);
      sending_->sent = std::move(listener.sent);
    }
    office_->boxes[static_cast<std::size_t>(rank_)]->listen(std::move(listener.receive),
                                                            std::move(listener.room));
  }

 private:
  /// Letters on their way; it outlives the exchange as long as there are any.
  struct Sending {
    std::uint64_t hold(SharedBytes bytes) {
      const std::lock_guard lock(mutex);
      held.emplace(next, std::move(bytes));
      return next++;
    }
    void delivered(std::uint64_t number) {
      {
        const std::lock_guard lock(mutex);
        held.erase(number);
      }
      const std::lock_guard lock(telling);
      if (sent) sent();
    }

    mutable std::mutex mutex;
    std::map<std::uint64_t, SharedBytes> held;  ///< until they are delivered, as in a network
    std::uint64_t next = 0;
    std::mutex telling;  ///< guards the next line
    std::function<void()> sent;
  };

  std::shared_ptr<Office> office_;
  int rank_;
  std::shared_ptr<Sending> sending_;
};

}  // namespace

std::vector<std::unique_ptr<Exchange>> thread_exchanges(const ThreadExchangeOptions& options) {
  const auto office = std::make_shared<Office>(options);
  std::vector<std::unique_ptr<Exchange>> out;
  for (int rank = 0; rank < options.ranks; ++rank) {
    out.push_back(std::make_unique<ThreadExchange>(office, rank));
  }
  return out;
}

}  // namespace mw::engine
