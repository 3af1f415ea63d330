"""The commands of the terminal, a file each: what it is for, its arguments, and `carry_out`.

They are all imported to read a command line, so what they need is imported where it is used.
"""
