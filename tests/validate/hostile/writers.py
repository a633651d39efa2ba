"""One command line for each kind of file that gonio writes."""

import shutil
import subprocess

import pictures

IES = "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 3 1 1 2 0.1 0.1 0.1\n1 1 100\n0 45 90\n0\n100 50 0\n"
LAMP = """
def Xform "Lit"
{
    def DiskLight "Face"
    {
        float inputs:radius = 0.1
    }
}
"""
SMALL = "--res 8 8 --spp 1 -q"
# By the ending of what is written, or by more where there are several: the words, with {} where the file's name stands.
WRITERS = {
    "exr": f"render stage.usda -o {{}} {SMALL}",
    "png": f"render stage.usda -o {{}} {SMALL}",
    "jpg": f"render stage.usda -o {{}} {SMALL}",
    "exr deep": f"render stage.usda -o beside.exr --deep {{}} {SMALL}",
    "sums": f"render stage.usda --checkpoint {{}} {SMALL}",
    "exr merged": "merge part.sums -o {} -q",
    "csv": "measure stage.usda --at 0,1,0 --spp 16 --csv {} -q",
    "png grid": "measure stage.usda --grid /Floor --spacing 1 --spp 16 -o {} -q",
    "usda": "map stage.usda --paths 4096 -o {} -q",
    "png map": "map stage.usda --paths 4096 -o {} -w 32 -q",
    "ldt": "goniometer stage.usda --luminaire /Lit --rays 100k -o {}",
    "svg": "goniometer stage.usda --luminaire /Lit --rays 100k --polar {}",
    "ies": "photometry lamp.ies --convert {}",
    "svg polar": "photometry lamp.ies --polar {}",
    "html": "report stage.usda -o {} --no-pictures --point-spp 16 -q",
    "png false": "falsecolor picture.exr --quantity luminance -o {}",
    "exr relit": "relight picture.exr -o {}",
}


def kitchen(command, folder):
    """A folder with all that these commands read."""
    pictures.stage(folder / "stage.usda", pictures.ROOM, pictures.LAMP, pictures.camera(), LAMP)
    (folder / "lamp.ies").write_text(IES)
    for words in (
        f"render stage.usda -o picture.exr --aov color,luminance --light-groups {SMALL}",
        f"render stage.usda --checkpoint part.sums {SMALL}",
    ):
        subprocess.run([*command, *words.split()], cwd=folder, check=True, timeout=60)
    return folder


def copied(kitchen, folder):
    """A folder of one test's own with the same files."""
    shutil.copytree(kitchen, folder, dirs_exist_ok=True)
    return folder


def words_of(name, target):
    """The command line that writes this file."""
    return [target if word == "{}" else word for word in WRITERS[name].split()]


def ending(name):
    return name.split()[0]
