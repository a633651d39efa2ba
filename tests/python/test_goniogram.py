"""Goniograms of IES and EULUMDAT files, as lights' descriptions have them."""

import gonio
import pytest

IES = """IESNA:LM-63-2002
TILT=NONE
1 1000 1 3 1 1 2 0 0 0
1 1 10
0 45 90
0
300 200 100
"""


def test_a_file_becomes_a_description():
    found, warnings = gonio.read_goniogram(IES.encode(), "lamp.ies")
    assert found["vertical_deg"] == [0, 45, 90]
    assert found["horizontal_deg"] == [0, 360]
    assert found["factors"] == [300, 200, 100, 300, 200, 100]
    # 1000 lm of the lamp, and a third of them leave the luminaire: worth a word.
    assert all(line.startswith("lamp.ies: ") for line in warnings)


def test_a_light_takes_it():
    scene = gonio.Scene()
    number = scene.add_light("sphere", (1.0, 1.0, 1.0), radius=0.1)
    light = scene.to_dict()["lights"][number]
    scene.put_light({**light, "goniogram": gonio.read_goniogram(IES.encode(), "lamp.ies")[0]}, number)
    assert scene.to_dict()["lights"][number]["goniogram"]["factors"][0] == 300


def test_a_broken_file_names_its_line():
    with pytest.raises(gonio.FormatError) as raised:
        gonio.read_goniogram(IES.replace("300 200 100", "300 two 100").encode(), "lamp.ies")
    assert raised.value.line == 7
    assert "lamp.ies:7: " in str(raised.value)


def test_what_is_no_luminaire_is_told():
    with pytest.raises(gonio.FormatError, match="neither"):
        gonio.read_goniogram(b"\x00\x01\x02", "lamp.bin")


def test_lamp_sets_and_tilt_are_chosen():
    tilting = IES.replace("TILT=NONE", "TILT=INCLUDE\n1\n2\n0 90\n1 0.5").encode()
    found, _ = gonio.read_goniogram(tilting, "lamp.ies", lamp_set=1, tilt=45)
    assert found["factors"][:3] == pytest.approx([225, 150, 75])
    figures = gonio.goniogram_figures(tilting, "lamp.ies", tilt=90)
    assert (figures["peak_cd"], figures["lamp_sets"], figures["has_tilt"]) == (150, 1, True)
    for arguments, words in (({"lamp_set": 2}, "the file has 1"), ({"lamp_set": 0}, "the file has 1"), ({"tilt": float("nan")}, "a number")):
        with pytest.raises(gonio.FormatError, match=words):
            gonio.read_goniogram(tilting, "lamp.ies", **arguments)
    with pytest.raises(gonio.FormatError, match="no tilt factors"):
        gonio.read_goniogram(IES.encode(), "lamp.ies", tilt=10)
