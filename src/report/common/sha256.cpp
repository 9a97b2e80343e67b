// By OpenSSL's libcrypto: the program has it loaded in any case, as the libraries behind PETSc use
// it, and its EVP interface is documented and kept.

#include "report/common/sha256.h"

#include "model/errors.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <memory>

namespace whirl::report {

std::string sha256(const std::vector<std::string> &texts) {
    const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(),
                                                                          &EVP_MD_CTX_free);
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned size = 0;
    bool done = context && EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) == 1;
    for (const std::string &text : texts)
        done = done && EVP_DigestUpdate(context.get(), text.data(), text.size()) == 1;
    if (!done || EVP_DigestFinal_ex(context.get(), digest.data(), &size) != 1)
        throw model::AnalysisFailure(
            "the hash of the case was not computed: OpenSSL refuses SHA-256");
    std::string hex;
    for (unsigned i = 0; i < size; ++i)
        hex += fmt::format("{:02x}", digest.at(i));
    return hex;
}

} // namespace whirl::report
