// SPDX-License-Identifier: Apache-2.0
#include "visit/face_files.h"

#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "base/descriptor.h"
#include "base/error.h"
#include "files/file_bytes.h"
#include "files/private_file.h"
#include "net/sealed_bytes.h"

namespace theatron::visit {
namespace {

constexpr std::size_t max_face_recording_bytes = std::size_t(256) << 20;
constexpr std::size_t max_face_network_bytes = 1 << 20;
constexpr std::size_t max_face_model_bytes = std::size_t(400) << 20;
// A seal takes fewer bytes than this.
constexpr std::size_t seal_bytes = 64;
constexpr std::size_t least_passphrase = 8, most_passphrase = 1024;

// A line of the terminal, which does not show what is typed.
class HiddenLine {
public:
    HiddenLine() : terminal_(open("/dev/tty", O_RDWR | O_CLOEXEC | O_NOCTTY)) {
        if (terminal_.get() < 0 || tcgetattr(terminal_.get(), &shown_) != 0)
            throw Error("There is no terminal to type a passphrase; give --passphrase-file FILE.");
        termios hidden = shown_;
        // Ctrl-C comes as a character, so that the terminal shows again what is typed.
        hidden.c_lflag &= ~tcflag_t(ECHO | ISIG);
        tcsetattr(terminal_.get(), TCSAFLUSH, &hidden);
    }
    ~HiddenLine() { tcsetattr(terminal_.get(), TCSAFLUSH, &shown_); }
    HiddenLine(const HiddenLine&) = delete;
    HiddenLine& operator=(const HiddenLine&) = delete;

    std::string ask(const std::string& prompt) {
        say(prompt);
        std::string line;
        for (char one = 0; line.size() < most_passphrase; line += one) {
            if (read(terminal_.get(), &one, 1) != 1 || one == ctrl_c)
                throw Error("No passphrase was typed; nothing was done.");
            if (one == '\n')
                break;
        }
        say("\n");
        return line;
    }

private:
    static constexpr char ctrl_c = 3;

    void say(const std::string& text) {
        // A terminal that takes no prompt still takes the passphrase.
        [[maybe_unused]] const auto written = write(terminal_.get(), text.data(), text.size());
    }

    Descriptor terminal_;
    termios shown_{};
};

}  // namespace

face::Source face_source(const std::string& name) {
    if (const auto source = face::source_of(name))
        return *source;
    throw Error("There is no tracker '" + name + "'; name arkit, unified, xr_fb or xr_htc.");
}

face::Recording read_face_recording(const std::string& file) {
    const Bytes bytes = files::read_file(file, max_face_recording_bytes);
    face::RecordingRead read = face::parse_recording(
        std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    if (!read.problem.empty())
        throw Error("'" + file + "' is no recording of a face: " + read.problem + ".");
    if (read.recording.takes.empty())
        throw Error("'" + file + "' has no row of one of the six emotions.");
    return std::move(read.recording);
}

face::Network read_face_network(const std::string& file) {
    const auto network = face::parse_network(files::read_file(file, max_face_network_bytes));
    if (!network)
        throw Error("'" + file + "' is no network of 'theatron face train': it is " +
                    std::string(to_text(network.error())) + ". Train it again.");
    return *network;
}

face::MorphModel read_face_model(const std::string& file) {
    if (file.empty())
        return face::generated_head();
    auto model = face::parse_model(files::read_file(file, max_face_model_bytes));
    if (!model)
        throw Error("'" + file + "' is no morphable head of 'theatron face model import': it is " +
                    std::string(to_text(model.error())) + ".");
    return std::move(*model);
}

Bytes sealed_face(const face::EnrolledFace& face, const std::string& passphrase) {
    return net::sealed_bytes(net::seal(face::enrolled_bytes(face), passphrase));
}

void require_own_face(const std::string& file) {
    const Bytes bytes = files::read_file(file, face::max_enrolled_bytes + seal_bytes);
    const ByteView magic = as_bytes(net::sealed_magic);
    if (bytes.size() < magic.size() || !std::equal(magic.begin(), magic.end(), bytes.begin()))
        throw Error("'" + file + "' is no face of 'theatron face enrol'.");
}

face::EnrolledFace read_own_face(const std::string& file, const std::string& passphrase) {
    const auto sealed =
        net::parse_sealed(files::read_file(file, face::max_enrolled_bytes + seal_bytes));
    if (!sealed)
        throw Error("'" + file + "' is no face of 'theatron face enrol': it is " +
                    std::string(to_text(sealed.error())) + ".");
    const auto content = net::unseal(*sealed, passphrase);
    if (!content)
        throw Error("'" + file +
                    "' does not open: the passphrase is another one, or the file was changed.");
    auto face = face::parse_enrolled(*content);
    if (!face)
        throw Error("The face in '" + file + "' is " + std::string(to_text(face.error())) +
                    "; enrol it again.");
    return std::move(*face);
}

std::string face_passphrase(const std::string& file, bool is_new) {
    std::string passphrase;
    if (!file.empty()) {
        const auto text = files::read_named_file(file, files::Privacy::secret, most_passphrase);
        if (!text)
            throw Error("There is no file '" + file + "' with the passphrase.");
        passphrase = text->substr(0, text->find_first_of("\r\n"));
    } else {
        HiddenLine line;
        passphrase = line.ask("Passphrase of the face: ");
        if (is_new && line.ask("The same once more: ") != passphrase)
            throw Error("The two passphrases differ; nothing was written.");
    }
    if (passphrase.empty())
        throw Error("The passphrase is empty; nothing was done.");
    if (is_new && passphrase.size() < least_passphrase)
        throw Error("The passphrase is shorter than eight characters; choose a longer one.");
    return passphrase;
}

}  // namespace theatron::visit
