// SPDX-License-Identifier: Apache-2.0
#include "standin_behaviour.h"

#include <cstdlib>
#include <sstream>

namespace standin {

Behaviour Behaviour::from_environment() {
    Behaviour behaviour;
    const char* set = std::getenv("K4A_STANDIN");
    std::istringstream words(set ? set : "");
    for (std::string word; std::getline(words, word, ',');) {
        const auto equals = word.find('=');
        behaviour.words_[word.substr(0, equals)] =
            equals == std::string::npos ? "" : word.substr(equals + 1);
    }
    return behaviour;
}

std::string Behaviour::text(const std::string& key, const std::string& otherwise) const {
    const auto found = words_.find(key);
    return found == words_.end() ? otherwise : found->second;
}

long Behaviour::number(const std::string& key, long otherwise) const {
    const auto found = words_.find(key);
    return found == words_.end() ? otherwise : std::atol(found->second.c_str());
}

}  // namespace standin
