// SPDX-License-Identifier: Apache-2.0
// theatron certificate
#include <netdb.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <thread>

#include "base/error.h"
#include "base/output.h"
#include "base/outside_text.h"
#include "base/steady_clock.h"
#include "certificate_place.h"
#include "commands.h"
#include "files/json_text.h"
#include "files/utc_text.h"
#include "host/host_identity.h"
#include "net/certificate.h"
#include "net/certificate_chain.h"
#include "net/certificate_request.h"

namespace theatron::app {
namespace {

namespace fs = std::filesystem;
using files::Owner;
using files::Privacy;

constexpr std::size_t max_certificate_bytes = 256 * 1024;
// A host looks at its files twice a second, and then at all its links.
constexpr Duration shown_patience = std::chrono::seconds(20);
constexpr std::size_t shown_of_file = 120;

struct CertificateFlags {
    std::string config, key, user;
    std::vector<std::string> names;  // request
    std::string request;
    bool makes_key = false;
    std::vector<std::string> certificates;  // install
    std::string certificate, made_key, state;
    bool json = false;
};

std::string shown_file(const fs::path& file) {
    return "'" + clean_text(file.string(), shown_of_file) + "'";
}

// A key that waits for its certificate, while the host still has the one before.
fs::path next_key(const fs::path& key) {
    return key.string() + ".new";
}

CertificatePlace place_of(const CertificateFlags& flags) {
    CertificatePlace place;
    if (!flags.config.empty() || flags.key.empty())
        place = find_certificate_place(flags.config);
    if (!flags.key.empty()) {
        place.is_named = place.is_named && place.key == fs::absolute(flags.key);
        place.key = fs::absolute(flags.key);
        place.certificate = fs::path(place.key).replace_extension(".pem");
    }
    if (!flags.certificate.empty())
        place.certificate = fs::absolute(flags.certificate);
    if (!flags.state.empty())
        place.state = flags.state;
    return place;
}

// The name under which the network knows this machine.
std::string machine_name() {
    char name[256] = "";
    if (gethostname(name, sizeof(name) - 1) != 0)
        return "";
    addrinfo hints{};
    hints.ai_flags = AI_CANONNAME;
    addrinfo* found = nullptr;
    std::string full = name;
    if (getaddrinfo(name, nullptr, &hints, &found) == 0 && found && found->ai_canonname)
        full = found->ai_canonname;
    if (found)
        freeaddrinfo(found);
    return full;
}

// Those of the command line, else the name in the links, else those of this machine.
std::vector<std::string> names_for(const CertificateFlags& flags, const CertificatePlace& place) {
    if (!flags.names.empty())
        return flags.names;
    if (!place.name.empty())
        return {place.name};
    const std::string name = machine_name();
    std::vector<std::string> names;
    if (!name.empty() && name != "localhost")
        names.push_back(name);
    names.push_back(host::outside_address());
    return names;
}

std::string lines_to_add(const CertificatePlace& place) {
    if (place.missing_lines.empty())
        return "";
    std::string text = "Add to " + place.config.string() + ", and start the host again:\n";
    for (const std::string& line : place.missing_lines)
        text += "  " + line + "\n";
    return text;
}

void make_request(const CertificateFlags& flags) {
    const CertificatePlace place = place_of(flags);
    const std::optional<Owner> owner = certificate_owner(flags.user, place.key);
    const std::vector<std::string> names = names_for(flags, place);
    const auto read = [&](const fs::path& file) {
        return files::read_private_file(file, Privacy::secret, files::max_private_file_bytes,
                                        owner);
    };
    const auto there = read(place.key), next = read(next_key(place.key));
    if (flags.makes_key && next)
        throw Error("The key " + shown_file(next_key(place.key)) +
                    " already waits for its certificate; install that, or delete this key first.");
    // A host whose key changes before its certificate does could not start again.
    const bool is_new = !there || flags.makes_key;
    const std::string key = is_new ? net::make_key() : next ? *next : *there;
    const fs::path key_file = there && (is_new || next) ? next_key(place.key) : place.key;
    std::string text;
    try {
        text = net::certificate_request(key, names);
    } catch (const Error& error) {
        throw Error("No request can be made with the key " + shown_file(key_file) + ": " +
                    error.what());
    }
    if (is_new)
        files::write_private_file(key_file, key, owner);
    const fs::path file = flags.request.empty() ? fs::path(place.key).replace_extension(".csr")
                                                : fs::absolute(flags.request);
    files::write_private_file(file, text, owner);
    if (flags.json)
        return output::result(files::json_text({{"request", file.string()},
                                                {"key", key_file.string()},
                                                {"key_is_new", is_new},
                                                {"names", names}}) +
                              "\n");
    std::string list;
    for (const std::string& name : names)
        list += (list.empty() ? "" : ", ") + name;
    output::print("The request " + file.string() + " is for " + list + ".\n" +
                  (is_new ? "Its key is new: " : "Its key was there already: ") +
                  key_file.string() +
                  ". It stays on this machine.\n"
                  "Give the request to your certification authority. With its answer:\n"
                  "  theatron certificate install ANSWER" +
                  (flags.config.empty() ? "" : " --config '" + flags.config + "'") +
                  (flags.key.empty() ? "" : " --key '" + flags.key + "'") + "\n");
}

// A certificate is no secret, and its file may belong to anybody: the key tells whose it is.
std::string read_answer(const std::string& file) {
    std::error_code error;
    if (!fs::is_regular_file(file, error))
        throw Error("There is no file " + shown_file(file) + " with a certificate.");
    std::ifstream in(file, std::ios::binary);
    if (!in)
        throw Error("Cannot read " + shown_file(file) + ": " + std::strerror(errno) + ".");
    std::string text(max_certificate_bytes + 1, '\0');
    in.read(text.data(), std::streamsize(text.size()));
    text.resize(std::size_t(in.gcount()));
    if (text.size() > max_certificate_bytes)
        throw Error("The file " + shown_file(file) + " is too long for certificates.");
    return text;
}

std::vector<std::string> read_certificates(const std::vector<std::string>& given) {
    std::vector<std::string> all;
    for (const std::string& file : given) {
        const std::string text = read_answer(file);
        try {
            const auto found = net::certificates_in(text);
            all.insert(all.end(), found.begin(), found.end());
        } catch (const Error& error) {
            throw Error("The file " + shown_file(file) + " cannot be used: " + error.what() + ".");
        }
    }
    return all;
}

struct Pair {
    net::CertificateChain chain;
    std::string key;
    bool is_key_new = false;  // it is not in its place yet
};

// The key that one of the certificates belongs to. Throws Error if there is none.
Pair pair_of(const std::vector<std::string>& certificates, const CertificatePlace& place,
             const CertificateFlags& flags, const std::optional<Owner>& owner) {
    std::vector<fs::path> keys{place.key, next_key(place.key)};
    if (!flags.made_key.empty())
        keys = {flags.made_key};
    bool is_any = false;
    for (const fs::path& file : keys) {
        const auto key =
            files::read_named_file(file, Privacy::secret, files::max_private_file_bytes, owner);
        if (!key)
            continue;
        is_any = true;
        try {
            if (auto chain = net::chain_of_key(certificates, *key))
                return {*std::move(chain), *key, file != place.key};
        } catch (const Error& error) {
            throw Error("The key " + shown_file(file) + " cannot be used: " + error.what() + ".");
        }
    }
    const std::string what = shown_file(flags.certificates.front());
    if (!is_any)
        throw Error("There is no key " + shown_file(keys.front()) + " for " + what +
                    "; 'theatron certificate request' makes one, and the request for its "
                    "certificate.");
    throw Error("No certificate in " + what + " belongs to the key " + shown_file(keys.front()) +
                "; it was made for another request. Nothing was changed.");
}

// True once the host's links have this certificate. A host that is behind a proxy has that of the
// proxy there.
bool wait_until_shown(const std::string& state, const std::string& fingerprint,
                      const std::optional<Owner>& owner) {
    const TimePoint end = steady_now() + shown_patience;
    while (host::read_address(state, owner).fingerprint != fingerprint) {
        if (steady_now() > end)
            return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return true;
}

void say_about(const net::CertificateChain& chain) {
    std::string text;
    for (const std::string& subject : chain.left_out)
        text += "Left out, as it is no part of the chain: " + subject + "\n";
    if (!chain.has_root && !net::is_known_here(chain.pem))
        text += "This machine does not know '" + chain.issuer +
                "', which signed the last certificate. If that is no root of your organisation, "
                "give its certificate, too: theatron certificate install CERTIFICATE ISSUERS\n";
    if (!text.empty())
        output::print(text, output::Stream::error);
}

void install_answer(const CertificateFlags& flags) {
    const CertificatePlace place = place_of(flags);
    const std::optional<Owner> owner = certificate_owner(flags.user, place.key);
    const Pair pair = pair_of(read_certificates(flags.certificates), place, flags, owner);
    const std::string mistake =
        net::certificate_mistake(pair.chain.pem, files::utc_now(), place.name);
    if (!mistake.empty())
        throw Error("The certificate in " + shown_file(flags.certificates.front()) +
                    " is not used: " + mistake + ". Nothing was changed.");

    // Between the two the host keeps the pair that it has read. A key that waited is deleted last,
    // so that the same command mends what a crash left.
    if (pair.is_key_new)
        files::write_private_file(place.key, pair.key, owner);
    files::write_private_file(place.certificate, pair.chain.pem, owner);
    if (pair.is_key_new && flags.made_key.empty())
        files::remove_private_file(next_key(place.key));

    const net::Certificate installed{pair.chain.pem, pair.key, ""};
    const std::string fingerprint = net::fingerprint_of(installed);
    const bool is_followed = place.is_named && !place.is_behind_proxy && !place.state.empty() &&
                             host::is_host_running(place.state);
    const bool is_shown = is_followed && wait_until_shown(place.state, fingerprint, owner);
    const std::string until = files::utc_text(net::validity_of(installed).ends);
    if (flags.json)
        output::result(files::json_text({{"certificate", place.certificate.string()},
                                         {"key", place.key.string()},
                                         {"until", until},
                                         {"names", net::names_of_certificate(pair.chain.pem)},
                                         {"fingerprint", fingerprint},
                                         {"shown", is_shown},
                                         {"lines_to_add", place.missing_lines}}) +
                       "\n");
    else
        output::print("The certificate is installed: " + place.certificate.string() + ", until " +
                      until + ".\n" + lines_to_add(place) +
                      (is_shown ? "The host that runs shows it now; nobody was dropped.\n" : ""));
    say_about(pair.chain);
    if (is_followed && !is_shown)
        throw Error(
            "The files are installed, but the host that runs does not show the new "
            "certificate; 'theatron status' and its log say why. If the configuration was "
            "changed since its start, start it again.");
}

void add_place_options(CLI::App* command, CertificateFlags& flags) {
    command->add_option("--config", flags.config,
                        "The host's configuration (default: the only one in /etc/theatron)");
    command->add_option("--key", flags.key,
                        "File of the key, for a host without a configuration (default: as the "
                        "configuration says, else beside it)");
    command->add_option("--user", flags.user,
                        "The user that the host runs as, who owns the files (default: for root "
                        "and files in /etc/theatron: theatron)");
    command->add_flag("--json", flags.json, "Print one JSON line");
}

void add_certificate_request(CLI::App& group) {
    const auto flags = std::make_shared<CertificateFlags>();
    CLI::App* command =
        group.add_subcommand("request", "Make a key, and the request for its certificate");
    command->footer(
        "A key that is there already is used again and never replaced. --new-key makes another\n"
        "one, which takes its place when its certificate is installed.\n"
        "\nExamples:\n"
        "  theatron certificate request\n"
        "  theatron certificate request --config /etc/theatron/or-3.conf --name "
        "or-3.hospital.example\n"
        "  theatron certificate request --key or-3.key --name or-3.hospital.example --name "
        "10.1.2.3");
    command->add_option("--name", flags->names,
                        "A name or an address of the host, for each one (default: 'public-name' "
                        "of the configuration, else those of this machine)");
    command->add_flag("--new-key", flags->makes_key, "Make another key");
    command->add_option("--request", flags->request,
                        "Write the request to this file (default: beside the key, .csr)");
    add_place_options(command, *flags);
    command->callback([flags] { make_request(*flags); });
}

void add_certificate_install(CLI::App& group) {
    const auto flags = std::make_shared<CertificateFlags>();
    CLI::App* command =
        group.add_subcommand("install", "Check the certificate of this host, and use it");
    command->footer(
        "It must belong to the key of the request, be valid now, and be for the name in the\n"
        "links; else nothing is changed. Issuers may come in any order, in PEM, DER or PKCS #7.\n"
        "A running host shows the new certificate within seconds and drops nobody.\n"
        "\nExamples:\n"
        "  theatron certificate install or-3.cer\n"
        "  theatron certificate install or-3.cer issuers.p7b --config /etc/theatron/or-3.conf\n"
        "  theatron certificate install fullchain.pem --from-key privkey.pem");
    command
        ->add_option("CERTIFICATE", flags->certificates,
                     "What the certification authority gave, and files with its issuers")
        ->required();
    command->add_option("--certificate", flags->certificate,
                        "Install it as this file (default: as the configuration says, else beside "
                        "the key, .pem)");
    command->add_option("--from-key", flags->made_key,
                        "The key of the certificate, where another program made it (ACME)");
    command->add_option("--state", flags->state,
                        "State folder of the host that runs, to see that it shows the certificate "
                        "(default: as the configuration or the service has it)");
    add_place_options(command, *flags);
    command->callback([flags] { install_answer(*flags); });
}

}  // namespace

void add_certificate_command(CLI::App& app) {
    CLI::App* group = app.add_subcommand(
        "certificate", "Ask for a certificate of your organisation, and install it");
    group->require_subcommand(1);
    add_certificate_request(*group);
    add_certificate_install(*group);
}

}  // namespace theatron::app
