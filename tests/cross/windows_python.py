"""Python for Windows out of a wheel that brings it along: `windows_python.py WHEEL FOLDER`.

Takes Python's library and modules, which must bear the Python Software Foundation's signature, and the C library beside them, which must bear
Microsoft's. Writes `python3.def`: the stable interface, handed on to that library.
"""

import io
import re
import sys
import zipfile
from pathlib import Path

import lief
from abi3info import DATAS, FUNCTIONS

WANTED = re.compile(r"(python3\d+\.dll|VCRUNTIME140(_1)?\.dll|libffi-8\.dll|[a-z_0-9]+\.pyd)", re.IGNORECASE)
SIGNERS = ("O=Python Software Foundation,", "O=Microsoft Corporation,")


def signed(code: bytes) -> bool:
    """Whether a file is what one of the two signed."""
    parsed = lief.parse(io.BytesIO(code))
    good = parsed.verify_signature() == lief.PE.Signature.VERIFICATION_FLAGS.OK
    subjects = [certificate.subject + "," for signature in parsed.signatures for certificate in signature.certificates]
    return good and any(signer in subject for subject in subjects for signer in SIGNERS)


def main() -> None:
    wheel, folder = Path(sys.argv[1]), Path(sys.argv[2])
    with zipfile.ZipFile(wheel) as packed:
        for name in packed.namelist():
            if name.startswith("deploy_libs/") and WANTED.fullmatch(Path(name).name):
                code = packed.read(name)
                if not signed(code):
                    sys.stderr.write(f"{name} is left out: it is not signed\n")
                    continue
                (folder / Path(name).name).write_bytes(code)
    library = next(folder.glob("python3?*.dll"))
    # LIEF's parts live as long as the whole has a name.
    whole = lief.parse(str(library))
    has = {entry.name for entry in whole.get_export().entries}
    lines = [f"{symbol.name} = {library.stem}.{symbol.name}" for symbol in FUNCTIONS if symbol.name in has]
    lines += [f"{symbol.name} = {library.stem}.{symbol.name} DATA" for symbol in DATAS if symbol.name in has]
    (folder / "python3.def").write_text("LIBRARY python3.dll\nEXPORTS\n" + "\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
