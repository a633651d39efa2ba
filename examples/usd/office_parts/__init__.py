"""The parts from which make_office.py builds its stage."""
