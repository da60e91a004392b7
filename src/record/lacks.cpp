// SPDX-License-Identifier: Apache-2.0
#include "record/lacks.h"

namespace theatron::record {

std::string letters_of(const Lacks& lacks) {
    std::string letters;
    for (const Lack lack : lacks)
        letters += char(lack);
    return letters;
}

Lacks lacks_of_letters(const std::string& letters) {
    Lacks lacks;
    for (const char letter : letters)
        if (!text_of(Lack(letter)).empty())
            lacks.insert(Lack(letter));
    return lacks;
}

std::string text_of(Lack lack) {
    switch (lack) {
        case Lack::camera_failed:
            return "a camera ended with a problem";
        case Lack::cut:
            return "another program cut its file";
        case Lack::end:
            return "the last pictures before its end did not come from the host";
        case Lack::files:
            return "files of it were deleted or renamed while it was recorded";
        case Lack::host_gone:
            return "the host did not come back";
        case Lack::index:
            return "its index could not be written";
        case Lack::pictures:
            return "pictures are missing";
        case Lack::refused:
            return "the host refused its recorder";
        case Lack::voices:
            return "parts of what people said are missing";
    }
    return "";
}

}  // namespace theatron::record
