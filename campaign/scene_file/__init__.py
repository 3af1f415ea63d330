"""Reading a scene file: text, units, bounds, rules that tie keys together, and the wording of mistakes."""
