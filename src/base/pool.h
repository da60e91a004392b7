// SPDX-License-Identifier: Apache-2.0
// Objects whose memory is used again, so that a running pipeline allocates nothing.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

namespace theatron {

// Hands out objects with the memory, and the stale content, of released ones.
// Thread safe. Objects may outlive the pool.
template <class T>
class Pool {
public:
    std::shared_ptr<T> take() {
        std::unique_ptr<T> object;
        {
            const std::lock_guard lock(shelf_->mutex);
            if (!shelf_->objects.empty()) {
                object = std::move(shelf_->objects.back());
                shelf_->objects.pop_back();
            }
        }
        if (!object)
            object = std::make_unique<T>();
        return {object.release(), [shelf = shelf_](T* used) {
                    std::unique_ptr<T> back(used);
                    const std::lock_guard lock(shelf->mutex);
                    if (shelf->objects.size() < max_kept)
                        shelf->objects.push_back(std::move(back));
                }};
    }

private:
    static constexpr std::size_t max_kept = 16;
    struct Shelf {
        std::mutex mutex;
        std::vector<std::unique_ptr<T>> objects;
    };
    std::shared_ptr<Shelf> shelf_ = std::make_shared<Shelf>();
};

}  // namespace theatron
