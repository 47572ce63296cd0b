// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/core/parallel.h"

#include <gtest/gtest.h>
#include <omp.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

namespace abradem::core {
namespace {

class Threads {
 public:
  explicit Threads(int count) : before_(omp_get_max_threads()) { omp_set_num_threads(count); }
  ~Threads() { omp_set_num_threads(before_); }

 private:
  int before_;
};

bool each_once(std::size_t count) {
  std::vector<int> calls(count, 0);
  parallel_for(
      count, [&](std::size_t i) { ++calls[i]; }, 2);
  return std::ranges::all_of(calls, [](int c) { return c == 1; });
}

TEST(Parallel, EveryIndexIsCalledOnceWithAnyNumberOfThreads) {
  for (const int threads : {1, 2, 3, 7, 2}) {
    const Threads use(threads);
    for (int repeat = 0; repeat < 300; ++repeat)
      for (const std::size_t count : {0U, 1U, 2U, 9U, 64U, 1001U})
        ASSERT_TRUE(each_once(count)) << count << " on " << threads;
  }
}

TEST(Parallel, LoopsAreSharedOutAndNeverAmongMoreThreadsThanAskedFor) {
  {
    const Threads use(6);
    EXPECT_TRUE(each_once(100));
  }  // so many are there
  const Threads use(2);
  std::mutex lock;
  std::set<std::thread::id> seen;
  std::atomic<int> started{0};
  for (int repeat = 0; repeat < 20 && seen.size() < 2; ++repeat) {
    started = 0;
    parallel_blocks(2, [&](std::size_t) {
      ++started;
      for (long k = 0; k < 100'000'000 && started < 2; ++k) std::this_thread::yield();
      const std::lock_guard hold(lock);
      seen.insert(std::this_thread::get_id());
    });
  }
  EXPECT_EQ(seen.size(), 2U);
}

TEST(Parallel, LoopsInsideLoopsAndBesideOthersAreDoneWhereTheyAre) {
  const Threads use(3);
  std::vector<char> nested(40, 0), beside(4, 0);
  parallel_blocks(nested.size(), [&](std::size_t i) { nested[i] = each_once(50 + i); });
  EXPECT_TRUE(std::ranges::all_of(nested, [](char c) { return c == 1; }));
  std::vector<std::thread> others;
  for (char& right : beside)
    others.emplace_back([&right] {
      right = 1;
      for (int repeat = 0; repeat < 200; ++repeat) right = right != 0 && each_once(97) ? 1 : 0;
    });
  for (std::thread& t : others) t.join();
  EXPECT_TRUE(std::ranges::all_of(beside, [](char c) { return c == 1; }));
}

TEST(Parallel, AForkedChildMakesThreadsOfItsOwn) {
  const Threads use(2);
  ASSERT_TRUE(each_once(100));
  const pid_t child = fork();
  if (child == 0) _exit(each_once(100) && each_once(1001) ? 0 : 1);
  int status = 1;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace abradem::core
