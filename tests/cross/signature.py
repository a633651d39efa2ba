"""The code signature of a macOS module: whether what is loaded is what was signed."""

import hashlib
import struct

EMBEDDED, DIRECTORY = 0xFADE0CC0, 0xFADE0C02
AD_HOC = 0x2
SHA256 = 2


def code_directory(code: bytes, start: int) -> int | None:
    """Where the directory of a signature begins that stands at `start` of the file."""
    magic, _, count = struct.unpack_from(">3I", code, start)
    if magic != EMBEDDED:
        return None
    slots = [struct.unpack_from(">2I", code, start + 12 + 8 * slot) for slot in range(count)]
    return next((start + offset for kind, offset in slots if kind == 0), None)


def flaw(code: bytes, start: int) -> str | None:
    """What is wrong with the signature at `start` of the file, for which the system would end a process that loads it."""
    directory = code_directory(code, start)
    if directory is None or struct.unpack_from(">I", code, directory)[0] != DIRECTORY:
        return "its signature has no directory"
    flags, digests, _, _, pages, limit = struct.unpack_from(">6I", code, directory + 12)
    size, kind, _, page = struct.unpack_from(">4B", code, directory + 36)
    if not flags & AD_HOC:
        return "its signature is not ad hoc"
    if kind != SHA256 or limit != start:
        return f"its signature covers {limit} bytes of {start} by digests of kind {kind}"
    if pages != -(-limit >> page):
        return f"its signature has {pages} pages"
    for number in range(pages):
        signed = code[number << page : min((number + 1) << page, limit)]
        at = directory + digests + number * size
        if hashlib.sha256(signed).digest() != code[at : at + size]:
            return f"page {number} of {pages} is not what was signed"
    return None
