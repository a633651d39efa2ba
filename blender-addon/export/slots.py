# SPDX-License-Identifier: GPL-3.0-or-later
"""Places in one of the scene's lists: kept for the same thing, given on when it is gone."""


class Slots:
    """Which number each key has, and what was last written there."""

    def __init__(self):
        self._numbers, self._written, self._used = {}, {}, set()
        self._free, self._length = [], 0

    def __contains__(self, key):
        return key in self._numbers

    def take(self, key):
        """The number of a key, and whether nothing of it was written there yet; the key counts as used."""
        self._used.add(key)
        if key in self._numbers:
            return self._numbers[key], False
        number = self._free.pop() if self._free else self._length
        self._length = max(self._length, number + 1)
        self._numbers[key] = number
        return number, True

    def written(self, number):
        """The description that stands at a place."""
        return self._written[number]

    def put(self, write, description, number):
        """Writes a description, if it differs from what stands there; gives whether it was written."""
        if number in self._written and self._written[number] == description:
            return False
        self.place(write, number, description)
        self._written[number] = description
        return True

    def place(self, write, number, *arguments, **keywords):
        """Calls a function of the scene that adds or replaces; a place whose thing it refuses is given back."""
        try:
            write(*arguments, index=number if number in self._written else None, **keywords)
        except Exception:
            self._give_back(number)
            raise
        # What holds buffers cannot be compared cheaply; its key tells whether it changed.
        self._written[number] = None

    def _give_back(self, number):
        """Forgets who has a place: one that was never written is the last and not in the scene's list."""
        for key in [key for key, value in self._numbers.items() if value == number]:
            del self._numbers[key]
        if number in self._written:
            self._free.append(number)
        else:
            self._length = number

    def begin(self):
        """Starts a pass after which keys that were not taken are gone."""
        self._used = set()

    def sweep(self):
        """Frees the places of keys that were not taken since the pass began; gives their numbers."""
        gone = [key for key in self._numbers if key not in self._used]
        freed = [self._numbers.pop(key) for key in gone]
        self._free += freed
        return freed

    def trim(self):
        """Gives back free places at the end of the list; gives how many are left."""
        while self._length - 1 in self._free:
            self._length -= 1
            self._free.remove(self._length)
            self._written.pop(self._length, None)
        return self._length
